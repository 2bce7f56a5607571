#include "io/gis/gdal_support.h"

#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <utility>
#include <vector>

#include "io/reference_system.h"
#include "io/ring_text.h"

namespace medial::io {

namespace {

/// Appends the points of a piece of a ring; its first one is the last of the piece before.
void add_curve(const OGRSimpleCurve& curve, Ring& ring) {
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(curve.getNumPoints()));
  for (int i = 0; i < curve.getNumPoints(); ++i) points.push_back({curve.getX(i), curve.getY(i)});
  add_piece(points, wkbFlatten(curve.getGeometryType()) == wkbCircularString, ring);
}

void add_ring(const OGRCurve& source, Ring& ring) {
  if (wkbFlatten(source.getGeometryType()) == wkbCompoundCurve) {
    for (const OGRCurve* part : *source.toCompoundCurve()) add_curve(*part->toSimpleCurve(), ring);
  } else {
    add_curve(*source.toSimpleCurve(), ring);
  }
}

void add_polygon(const OGRCurvePolygon& polygon, std::vector<Ring>& rings) {
  RingRole role = RingRole::outer;
  for (const OGRCurve* source : polygon) {
    Ring& ring = rings.emplace_back();
    ring.role = role;
    role = RingRole::hole;
    add_ring(*source, ring);
  }
}

/// GDAL's access to the network, taken from it until the user names a server.
struct Network {
  std::mutex mutex;
  std::atomic<bool> is_allowed = false;
  std::vector<GDALDriver*> drivers;
  std::vector<std::pair<std::string, VSIFilesystemHandler*>> handlers;  ///< by their prefixes
};
Network& network() {
  static auto* const network = new Network;  // never destroyed, like GDAL's own drivers
  return *network;
}

/// The drivers of servers, and those that pass names on to other programs or fetch schemas.
bool is_of_servers(GDALDriver& driver) {
  const std::string_view name = driver.GetDescription();
  return driver.GetMetadataItem(GDAL_DMD_CONNECTION_PREFIX) != nullptr || name == "OGR_OGDI" ||
         name == "PGeo";
}

bool is_of_network(std::string_view prefix) {
  constexpr std::array<std::string_view, 9> begins{"/vsicurl",  "/vsis3",      "/vsigs",
                                                   "/vsiaz",    "/vsiadls",    "/vsioss",
                                                   "/vsiswift", "/vsiwebhdfs", "/vsihdfs"};
  return std::ranges::any_of(begins, [&](auto begin) { return prefix.starts_with(begin); });
}

void report_refusal(const char* name, CPLErr level) {
  CPLError(level, CPLE_AppDefined, "%s was not fetched: files open no connections", name);
}

/// Answers requests instead of the network.
CPLHTTPResult* refuse_request(const char* url, CSLConstList, GDALProgressFunc, void*,
                              CPLHTTPFetchWriteFunc, void*, void*) {
  if (network().is_allowed) return nullptr;  // GDAL asks the network
  auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup(fmt::format("{} was not fetched", url).c_str());
  report_refusal(url, CE_Warning);
  return result;
}

/// A file system without files, in place of those of the network.
class NoFiles final : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char* name, const char*, bool, CSLConstList) override {
    report_refusal(name, CE_Failure);
    return nullptr;
  }
  int Stat(const char*, VSIStatBufL*, int) override { return -1; }
};

}  // namespace

void register_gdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    // Nothing is written beside what is read.
    CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
    CPLHTTPSetFetchCallback(refuse_request, nullptr);
    GDALAllRegister();
    Network& own = network();
    const std::lock_guard lock(own.mutex);
    GDALDriverManager& manager = *GetGDALDriverManager();
    for (int i = manager.GetDriverCount() - 1; i >= 0; --i)
      if (GDALDriver* driver = manager.GetDriver(i); is_of_servers(*driver)) {
        manager.DeregisterDriver(driver);
        own.drivers.push_back(driver);
      }
    const CPLStringList prefixes(VSIFileManager::GetPrefixes());
    for (int i = 0; i < prefixes.Count(); ++i) {
      const std::string prefix = prefixes[i];
      if (!is_of_network(prefix)) continue;
      own.handlers.emplace_back(prefix, VSIFileManager::GetHandler(prefix.c_str()));
      VSIFileManager::InstallHandler(prefix, new NoFiles);
    }
  });
}

void allow_network_for(const std::string& name) {
  register_gdal();
  Network& own = network();
  const std::lock_guard lock(own.mutex);
  const auto is_named = [&name](GDALDriver* driver) {
    const char* prefix = driver->GetMetadataItem(GDAL_DMD_CONNECTION_PREFIX);
    return STARTS_WITH_CI(name.c_str(), prefix != nullptr ? prefix : "PGEO:");
  };
  if (name.find("://") == std::string::npos &&
      std::ranges::none_of(own.handlers, [&](const auto& h) { return name.find(h.first) == 0; }) &&
      std::ranges::none_of(own.drivers, is_named))
    return;
  own.is_allowed = true;
  for (GDALDriver* driver : std::exchange(own.drivers, {}))
    GetGDALDriverManager()->RegisterDriver(driver);
  for (const auto& [prefix, handler] : std::exchange(own.handlers, {}))
    VSIFileManager::InstallHandler(prefix, handler);
}

MemoryFile::MemoryFile(std::string& bytes, std::string_view extension)
    : name_(fmt::format("/vsimem/medial_{}{}", static_cast<const void*>(&bytes), extension)) {
  VSILFILE* file = VSIFileFromMemBuffer(name_.c_str(), reinterpret_cast<GByte*>(bytes.data()),
                                        bytes.size(), FALSE);
  if (file == nullptr)
    name_.clear();
  else
    VSIFCloseL(file);
}

MemoryFile::~MemoryFile() {
  if (!name_.empty()) VSIUnlink(name_.c_str());
}

GdalMessages::GdalMessages() { CPLPushErrorHandlerEx(&GdalMessages::collect, this); }

GdalMessages::~GdalMessages() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void CPL_STDCALL GdalMessages::collect(CPLErr level, CPLErrorNum, const char* text) {
  auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
  if (level == CE_Debug || level == CE_None) return;
  std::string line = text;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, ' ');
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  constexpr std::size_t enough = 20;  // a broken file can warn at each of its features
  // What is no news, or noted in other words.
  if (line.starts_with("Non closed ring detected") ||
      line.starts_with("This version of GeoPackage") ||
      line.ends_with("non conformant file extension"))
    return;
  if (level == CE_Warning) {
    if (self->warnings_.size() < enough &&
        std::ranges::find(self->warnings_, line) == self->warnings_.end()) {
      self->warnings_.push_back(std::move(line));
    }
  } else if (self->failure_.empty()) {
    self->failure_ = std::move(line);
  }
}

namespace {

/// Appends a point or a line; false where the geometry is neither.
bool add_chain(const OGRGeometry& part, std::vector<Chain>& chains) {
  switch (wkbFlatten(part.getGeometryType())) {
    case wkbPoint: {
      const OGRPoint* point = part.toPoint();
      if (!point->IsEmpty()) chains.push_back({{{point->getX(), point->getY()}}});
      return true;
    }
    case wkbLineString:
    case wkbCircularString:
    case wkbCompoundCurve: {
      Ring line;
      add_ring(*part.toCurve(), line);
      if (!line.points.empty())
        chains.push_back({std::move(line.points), std::move(line.bulges), false});
      return true;
    }
    default:
      return false;
  }
}

}  // namespace

void add_loose(const OGRGeometry& geometry, Feature& feature, GeometryCounts& counts) {
  std::vector<const OGRGeometry*> waiting{&geometry};
  while (!waiting.empty()) {
    const OGRGeometry* part = waiting.back();
    waiting.pop_back();
    if (add_chain(*part, feature.chains)) continue;
    const OGRwkbGeometryType type = wkbFlatten(part->getGeometryType());
    if (type == wkbMultiPoint || type == wkbMultiLineString || type == wkbMultiCurve ||
        type == wkbGeometryCollection) {
      const OGRGeometryCollection* collection = part->toGeometryCollection();
      for (int i = collection->getNumGeometries(); i > 0; --i)
        waiting.push_back(collection->getGeometryRef(i - 1));
      continue;
    }
    add_rings(*part, feature.rings, counts);
  }
}

void add_rings(const OGRGeometry& geometry, std::vector<Ring>& rings, GeometryCounts& counts) {
  std::vector<const OGRGeometry*> waiting{&geometry};
  while (!waiting.empty()) {
    const OGRGeometry* part = waiting.back();
    waiting.pop_back();
    switch (wkbFlatten(part->getGeometryType())) {
      case wkbPolygon:
      case wkbTriangle:
      case wkbCurvePolygon:
        add_polygon(*part->toCurvePolygon(), rings);
        break;
      case wkbMultiPolygon:
      case wkbMultiSurface:
      case wkbGeometryCollection: {
        const OGRGeometryCollection* collection = part->toGeometryCollection();
        for (int i = collection->getNumGeometries(); i > 0; --i) {
          waiting.push_back(collection->getGeometryRef(i - 1));
        }
        break;
      }
      default:
        ++counts.others;
    }
  }
}

namespace {

void describe_units(const OGRSpatialReference& reference, DocumentInfo& dataset) {
  dataset.geographic = reference.IsGeographic() != 0;
  if (dataset.geographic)
    dataset.unit = Unit::degree;
  else
    dataset.unit = unit_of_length(1e3 * reference.GetLinearUnits());
}

}  // namespace

void set_crs(const OGRSpatialReference& reference, DocumentInfo& dataset) {
  if (const char* name = reference.GetName(); name != nullptr && EQUAL(name, no_reference)) return;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  if (reference.exportToWkt(&text, options) == OGRERR_NONE && text != nullptr) {
    dataset.crs_wkt = text;
    describe_units(reference, dataset);
  }
  CPLFree(text);
}

bool find_crs(const std::string& name, OGRSpatialReference& reference) {
  // GDAL ignores what follows the digits of a code.
  if (STARTS_WITH_CI(name.c_str(), "EPSG:") &&
      name.find_first_not_of("0123456789+", 5) != std::string::npos)
    return false;
  return reference.SetFromUserInput(name.c_str(),
                                    OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) ==
         OGRERR_NONE;
}

Status describe_crs(const std::string& name, DocumentInfo& dataset) {
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (!find_crs(name, reference))
    return Error{ErrorCode::invalid_option,
                 fmt::format("'{}' does not name a reference system; use EPSG:n or WKT", name),
                 {}};
  set_crs(reference, dataset);
  return success();
}

void describe_crs(DocumentInfo& dataset) {
  const std::string& name = dataset.crs_wkt;
  const bool coded = name.starts_with("EPSG:");
  const bool described = name.empty() || dataset.geographic || dataset.unit != Unit::unknown;
  if (described && !coded) return;
  const GdalMessages messages;
  OGRSpatialReference reference;
  if (find_crs(name, reference)) {
    if (coded)
      set_crs(reference, dataset);
    else
      describe_units(reference, dataset);
  } else if (coded) {
    dataset.notes.push_back(fmt::format("the reference system {} is not known", name));
    dataset.crs_wkt.clear();
  } else {
    dataset.notes.push_back("the reference system is not understood");
  }
}

}  // namespace medial::io

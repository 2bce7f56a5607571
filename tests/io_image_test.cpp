// Images in, distances out, and files that are neither.
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>

#include "medial/io/read.h"
#include "medial/io/write.h"
#include "support/scratch_folder.h"

namespace medial::io {
namespace {

class ImageFiles : public test::ScratchFolder {
 protected:
  /// Writes values, row after row, through GDAL.
  std::string write_raster(const std::string& name, const char* driver, int width,
                           std::vector<double> values, GDALDataType type, int bands = 1,
                           const std::function<void(GDALDataset&)>& change = {}) const {
    GDALAllRegister();
    auto* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
    const int height = static_cast<int>(values.size()) / width / bands;
    const std::unique_ptr<GDALDataset> source(
        memory->Create("", width, height, bands, type, nullptr));
    EXPECT_EQ(source->RasterIO(GF_Write, 0, 0, width, height, values.data(), width, height,
                               GDT_Float64, bands, nullptr, 0, 0, 0, nullptr),
              CE_None);
    if (change) change(*source);
    const std::unique_ptr<GDALDataset> written(
        GetGDALDriverManager()->GetDriverByName(driver)->CreateCopy(
            path(name).c_str(), source.get(), FALSE, nullptr, nullptr, nullptr));
    EXPECT_TRUE(written);
    return path(name);
  }

  static std::string rows(const Result<ImageFile>& file) {
    if (!file) return to_string(file.error());
    std::string text;
    for (std::uint32_t y = 0; y < file->image.height(); ++y) {
      for (std::uint32_t x = 0; x < file->image.width(); ++x)
        text += file->image.at(x, y) ? '#' : '.';
      text += '/';
    }
    return text;
  }
  ErrorCode code_of(const std::string& name, const std::string& content,
                    const ImageOptions& options = {}) const {
    const Result<ImageFile> file = read_image(write(name, content), options);
    return file ? ErrorCode::internal : file.error().code;
  }
};

TEST_F(ImageFiles, PortableBitmapsAndGraymaps) {
  EXPECT_EQ(rows(read_image(write("a.pbm", "P1\n# a comment\n3 2\n101\n0 1 0\n"))), "#.#/.#./");
  EXPECT_EQ(rows(read_image(write("b.pbm", std::string("P4 9 2\n\x80\x80\x01\x00", 11)))),
            "#.......#/.......#./");
  EXPECT_EQ(rows(read_image(write("c.pgm", "P2 3 1 255 127 128 255\n"))), ".##/");
  EXPECT_EQ(rows(read_image(write("d.pgm", std::string("P5 3 1 255\n\x7f\x80\xff")))), ".##/");
  EXPECT_EQ(rows(read_image(write("e.pgm", std::string("P5 2 1 65535\n\x7f\xff\x80\x00", 17)))),
            ".#/");
  EXPECT_EQ(rows(read_image(write("c.pgm", "P2 3 1 255 127 128 255\n"), {200.0, false})), "..#/");
  EXPECT_EQ(rows(read_image(write("c.pgm", "P2 3 1 255 127 128 255\n"), {200.0, true})), "##./");
}

TEST_F(ImageFiles, PngAndTiff) {
  EXPECT_EQ(rows(read_image(write_raster("a.png", "PNG", 2, {0, 127, 128, 255}, GDT_Byte))),
            "../##/");
  EXPECT_EQ(rows(read_image(write_raster("b.png", "PNG", 2, {0, 32767, 32768, 9}, GDT_UInt16))),
            "../#./");
  EXPECT_EQ(rows(read_image(write_raster("c.tif", "GTiff", 3, {0.4, 0.5, NAN}, GDT_Float32))),
            ".#./");
  EXPECT_EQ(
      rows(read_image(write_raster("d.tif", "GTiff", 3, {-5, 3, 4}, GDT_Int16), {3.0, false})),
      ".##/");
  // Red, green and blue of four pixels, and how opaque they are.
  const auto opaque = [](GDALDataset& dataset) {
    dataset.GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand);
  };
  EXPECT_EQ(
      rows(read_image(write_raster(
          "e.png", "PNG", 4, {255, 0, 255, 255, 0, 255, 255, 255, 0, 0, 255, 255, 255, 255, 255, 0},
          GDT_Byte, 4, opaque))),
      ".##./");
  // Values without data are background, whatever is asked for.
  const auto no_data = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(7); };
  EXPECT_EQ(rows(read_image(write_raster("f.tif", "GTiff", 3, {7, 8, 200}, GDT_Byte, 1, no_data),
                            {std::nullopt, true})),
            ".#./");
}

TEST_F(ImageFiles, TellWhereTheyLie) {
  const auto place = [](GDALDataset& dataset) {
    double transform[] = {500000, 10, 0, 5400000, 0, -10};
    dataset.SetGeoTransform(transform);
    OGRSpatialReference reference;
    reference.importFromEPSG(32632);
    dataset.SetSpatialRef(&reference);
  };
  const Result<ImageFile> file =
      read_image(write_raster("a.tif", "GTiff", 2, {0, 255, 255, 255}, GDT_Byte, 1, place));
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE(file->placed());
  EXPECT_EQ(file->placement, (PixelPlacement{500000, 10, 0, 5400000, 0, -10}));
  EXPECT_FALSE(file->geographic);
  EXPECT_NE(file->crs_wkt.find("UTM zone 32N"), std::string::npos);

  // So do their distances.
  const auto distances = distance_transform(file->image);
  ASSERT_TRUE(distances.ok());
  ASSERT_TRUE(write_distances(path("b.tif"), *distances, *file).ok());
  const std::unique_ptr<GDALDataset> back(GDALDataset::Open(path("b.tif").c_str()));
  ASSERT_TRUE(back);
  double transform[6];
  EXPECT_EQ(back->GetGeoTransform(transform), CE_None);
  EXPECT_EQ(transform[3], 5400000);
  EXPECT_FALSE(read_image(write("c.pbm", "P1 1 1 1"))->placed());
}

TEST_F(ImageFiles, AreRefusedWithACode) {
  EXPECT_EQ(read_image(path("none.png")).error().code, ErrorCode::unreadable);
  EXPECT_EQ(code_of("a.png", "x y text"), ErrorCode::unsupported);
  EXPECT_EQ(code_of("b.png", ""), ErrorCode::empty);
  EXPECT_EQ(code_of("c.pbm", "P1 2 2 1 0 1"), ErrorCode::malformed);
  EXPECT_EQ(code_of("d.pbm", "P1 2 2 1 0 1 2"), ErrorCode::malformed);
  EXPECT_EQ(code_of("e.pbm", "P4 20 20\nxx"), ErrorCode::malformed);
  EXPECT_EQ(code_of("f.pbm", "P4 20"), ErrorCode::malformed);
  EXPECT_EQ(code_of("g.pgm", "P2 1 1 70000 3"), ErrorCode::malformed);
  EXPECT_EQ(code_of("h.pgm", "P2 1 1 255 256"), ErrorCode::malformed);
  EXPECT_EQ(code_of("i.pbm", "P4 0 5\n"), ErrorCode::malformed);
  EXPECT_EQ(code_of("j.pbm", "P4 65535 65535\n"), ErrorCode::too_large);
  EXPECT_EQ(code_of("k.pbm", "P4 99999999999999999999 1\n"), ErrorCode::malformed);
  EXPECT_EQ(code_of("l.pbm", "P1 2 1 0 0"), ErrorCode::empty);
  EXPECT_EQ(code_of("m.pbm", "P1 2 1 1 1", {std::nullopt, true}), ErrorCode::empty);
  EXPECT_TRUE(is_image(write("n.pbm", "P1 2 1 0 0")));
  EXPECT_FALSE(is_image(write("o.wkt", "POLYGON EMPTY")));
  EXPECT_FALSE(is_image(path("none")));
}

TEST_F(ImageFiles, DamagedOnesAreErrorsOrImages) {
  // Every cut and many changed bytes of a PNG and a TIFF.
  std::vector<double> values(40 * 30);
  std::mt19937 random(5);
  for (double& value : values) value = static_cast<double>(random() % 256);
  for (const auto& [name, driver] : {std::pair{"a.png", "PNG"}, {"a.tif", "GTiff"}}) {
    write_raster(name, driver, 40, values, GDT_Byte);
    const std::string whole = content(name);
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60) {
      const Result<ImageFile> cut = read_image(write("cut", whole.substr(0, length)));
      EXPECT_FALSE(cut.ok() && length < whole.size() / 2) << name << " " << length;
    }
    for (int i = 0; i < 300; ++i) {
      std::string changed = whole;
      changed[random() % (i % 2 == 0 ? 100 : whole.size())] = static_cast<char>(random());
      const Result<ImageFile> file = read_image(write("changed", changed));
      EXPECT_TRUE(file.ok() || !file.error().text.empty());
    }
  }
}

TEST_F(ImageFiles, DistancesComeBack) {
  ImageFile file;
  file.image = Image(5, 5);
  for (std::uint32_t i = 0; i < 25; ++i) file.image.set(i % 5, i / 5);
  const auto distances = distance_transform(file.image);
  const auto cracks = distance_transform(file.image, {DistanceTo::cracks, true, 1});
  ASSERT_TRUE(distances.ok() && cracks.ok());
  const auto middle_of = [this](const std::string& name) {
    const std::unique_ptr<GDALDataset> back(GDALDataset::Open(path(name).c_str()));
    double value = -1;
    EXPECT_TRUE(back);
    EXPECT_EQ(back->GetRasterBand(1)->RasterIO(GF_Read, 2, 2, 1, 1, &value, 1, 1, GDT_Float64, 0, 0,
                                               nullptr),
              CE_None);
    return value;
  };
  ASSERT_TRUE(write_distances(path("a.tif"), *distances, file).ok());
  ASSERT_TRUE(write_distances(path("b.tif"), *distances, file, {true, 1}).ok());
  ASSERT_TRUE(write_distances(path("c.png"), *distances, file, {false, 100}).ok());
  ASSERT_TRUE(write_distances(path("d.pgm"), *distances, file, {true, 1}).ok());
  ASSERT_TRUE(write_distances(path("e.tif"), *cracks, file, {true, 1}).ok());
  EXPECT_EQ(middle_of("a.tif"), 3);
  EXPECT_EQ(middle_of("b.tif"), 9);
  EXPECT_EQ(middle_of("c.png"), 300);
  EXPECT_EQ(middle_of("d.pgm"), 9);
  EXPECT_EQ(middle_of("e.tif"), 6.25);
  for (const auto& entry : std::filesystem::directory_iterator(directory_))
    EXPECT_EQ(entry.path().string().find(".aux"), std::string::npos) << entry;

  EXPECT_EQ(write_distances(path("f.jpg"), *distances, file).error().code, ErrorCode::unsupported);
  EXPECT_EQ(write_distances(path("f.png"), *distances, file, {false, 1e5}).error().code,
            ErrorCode::invalid_option);
  EXPECT_EQ(write_distances(path("no/f.png"), *distances, file).error().code,
            ErrorCode::unwritable);
  const auto open = distance_transform(file.image, {DistanceTo::pixels, false, 1});
  ASSERT_TRUE(open.ok());
  EXPECT_EQ(write_distances(path("f.tif"), *open, file).error().code, ErrorCode::invalid_option);
  EXPECT_FALSE(std::filesystem::exists(path("f.tif")));
}

TEST_F(ImageFiles, ImagesComeBack) {
  ImageFile file;
  file.image = Image(19, 3);
  for (std::uint32_t i = 0; i < 57; i += 2) file.image.set(i % 19, i / 19);
  for (const char* name : {"a.png", "a.tif", "a.pbm"}) {
    ASSERT_TRUE(write_image(path(name), {}, file.image, file).ok());
    const Result<ImageFile> back = read_image(path(name));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->image, file.image) << name;
  }
  EXPECT_EQ(write_image(path("a.gif"), {}, file.image, file).error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace medial::io

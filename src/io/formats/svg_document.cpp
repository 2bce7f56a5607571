#include "io/formats/svg_document.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <libxml/SAX2.h>
#include <libxml/parser.h>

#include <array>
#include <optional>
#include <string_view>

#include "io/formats/svg_style.h"

namespace medial::io {

namespace {

constexpr std::size_t longest_document = (std::size_t{1} << 31U) - 1;  // what libxml2 takes
constexpr std::size_t longest_entity = 256;
constexpr int deepest_element =
    1000;  // open elements; the reader allows fewer, with a better error
constexpr char svg_namespace[] = "http://www.w3.org/2000/svg";
constexpr char xlink_namespace[] = "http://www.w3.org/1999/xlink";
constexpr char xml_space[] = " \t\r\n";

const xmlChar* as_xml(const char* text) { return reinterpret_cast<const xmlChar*>(text); }

std::string_view as_text(const xmlChar* text) {
  return text == nullptr ? std::string_view() : reinterpret_cast<const char*>(text);
}

using XmlText = std::unique_ptr<xmlChar, decltype(xmlFree)>;

void declare_entity(void* context, const xmlChar* name, int type, const xmlChar* public_id,
                    const xmlChar* system_id, xmlChar* content) {
  const std::string_view text = as_text(content);
  if (type != XML_INTERNAL_GENERAL_ENTITY || text.size() > longest_entity ||
      text.find('&') != std::string_view::npos) {
    return;
  }
  xmlSAX2EntityDecl(context, name, type, public_id, system_id, content);
}

/// Stops before a small compressed file of nothing but opened elements fills the memory.
void start_element(void* context, const xmlChar* name, const xmlChar* prefix, const xmlChar* uri,
                   int namespaces, const xmlChar** namespace_names, int attributes, int defaulted,
                   const xmlChar** attribute_values) {
  const auto parser = static_cast<xmlParserCtxtPtr>(context);
  if (parser->nodeNr >= deepest_element) {
    xmlStopParser(parser);
    return;
  }
  xmlSAX2StartElementNs(context, name, prefix, uri, namespaces, namespace_names, attributes,
                        defaulted, attribute_values);
}

/// Attributes without which an element paints nothing.
struct Required {
  std::string_view element;
  std::array<const char*, 2> attributes;
};
constexpr std::array<Required, 7> required_attributes{{{"path", {"d", nullptr}},
                                                       {"rect", {"width", "height"}},
                                                       {"circle", {"r", nullptr}},
                                                       {"ellipse", {"rx", "ry"}},
                                                       {"polygon", {"points", nullptr}},
                                                       {"polyline", {"points", nullptr}},
                                                       {"line", {nullptr, nullptr}}}};

bool paints_nothing(const xmlNode* node) {
  const std::string_view name = as_text(node->name);
  for (const Required& required : required_attributes) {
    if (name != required.element) continue;
    if (name == "line") return true;
    for (const char* wanted : required.attributes) {
      if (wanted == nullptr) continue;
      const std::string value = attribute(node, wanted);
      if (value == "none" || value.find_first_not_of(xml_space) == std::string::npos) return true;
    }
  }
  return false;
}

/// Whether an element is a text or a picture that is shown where it stands.
bool is_text_or_picture(const xmlNode* node) {
  const std::string_view own = as_text(node->name);
  if (own != "text" && own != "image") return false;
  for (; node != nullptr && node->type == XML_ELEMENT_NODE; node = node->parent) {
    const std::string_view name = as_text(node->name);
    for (const std::string_view unseen :
         {"defs", "symbol", "clipPath", "mask", "pattern", "marker", "foreignObject"})
      if (name == unseen) return false;
    if (attribute(node, "display") == "none") return false;
  }
  return true;
}

/// The element that follows in document order; `descend`: children included.
xmlNode* next_node(xmlNode* node, const xmlNode* root, bool descend) {
  if (descend && node->children != nullptr && node->type == XML_ELEMENT_NODE) {
    return node->children;
  }
  while (node != root && node->next == nullptr) node = node->parent;
  return node == root ? nullptr : node->next;
}

/// A number at the beginning of a text, which loses it and what separates numbers.
std::optional<double> take_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n,"), text.size()));
  double value = 0;
  const auto [end, problem] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

std::string attribute(const xmlNode* node, const char* name) {
  const XmlText value(xmlGetNoNsProp(node, as_xml(name)), xmlFree);
  return std::string(as_text(value.get()));
}

std::uint64_t line_of(const xmlNode* node) {
  return static_cast<std::uint64_t>(std::max(xmlGetLineNo(node), 1L));
}

Result<SvgDocument> SvgDocument::read(TextSource& source) {
  std::string bytes;
  source.read_all(bytes, longest_document);
  if (source.failure()) return *source.failure();
  const auto error = [&source](ErrorCode code, std::string text, std::uint64_t line) {
    Error result = source.error(code, std::move(text));
    result.place.line.reset();
    if (line > 0) result.place.line = line;
    return result;
  };
  if (bytes.size() >= longest_document) return error(ErrorCode::too_large, "2 GiB or more", 0);

  const std::unique_ptr<xmlParserCtxt, decltype(&xmlFreeParserCtxt)> context(xmlNewParserCtxt(),
                                                                             &xmlFreeParserCtxt);
  if (!context) return error(ErrorCode::out_of_memory, "there is not enough memory", 0);
  context->sax->entityDecl = &declare_entity;
  context->sax->startElementNs = &start_element;
  constexpr int options = XML_PARSE_NOENT | XML_PARSE_NONET | XML_PARSE_NOERROR |
                          XML_PARSE_NOWARNING | XML_PARSE_COMPACT | XML_PARSE_HUGE |
                          XML_PARSE_BIG_LINES;
  SvgDocument result;
  result.document_.reset(xmlCtxtReadMemory(
      context.get(), bytes.data(), static_cast<int>(bytes.size()), nullptr, nullptr, options));
  if (!result.document_ || result.root() == nullptr) {
    const xmlError* problem = xmlCtxtGetLastError(context.get());
    if (problem != nullptr && problem->code == XML_ERR_USER_STOP) {
      return error(ErrorCode::malformed,
                   fmt::format("elements are more than {} deep", deepest_element), 0);
    }
    if (problem != nullptr && problem->code == XML_ERR_NO_MEMORY) {
      return error(ErrorCode::out_of_memory, "there is not enough memory", 0);
    }
    std::string text =
        problem != nullptr && problem->message != nullptr ? problem->message : "this is not XML";
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    return error(ErrorCode::malformed, text,
                 problem != nullptr ? static_cast<std::uint64_t>(std::max(problem->line, 0)) : 0);
  }
  if (as_text(result.root()->name) != "svg") {
    return error(ErrorCode::malformed, "the outermost element is not 'svg'",
                 line_of(result.root()));
  }
  result.prepare();
  if (!result.apply_styles()) {
    return error(ErrorCode::too_large, "there are too many style rules for the number of elements",
                 0);
  }
  return result;
}

xmlNode* SvgDocument::find(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? nullptr : found->second;
}

void SvgDocument::prepare() {
  xmlNode* const top = root();
  const bool nameless = top->ns == nullptr;
  xmlNs* const svg = nameless ? xmlNewNs(top, as_xml(svg_namespace), nullptr) : top->ns;
  xmlNs* xlink = xmlSearchNsByHref(document_.get(), top, as_xml(xlink_namespace));
  xmlNode* next = nullptr;
  for (xmlNode* node = top; node != nullptr; node = next) {
    const bool element = node->type == XML_ELEMENT_NODE;
    if (element && nameless && node->ns == nullptr) node->ns = svg;
    if (element && paints_nothing(node)) {
      next = next_node(node, top, false);
      xmlUnlinkNode(node);
      xmlFreeNode(node);
      continue;
    }
    next = next_node(node, top, true);
    if (!element) continue;
    if (is_text_or_picture(node)) ++texts_and_pictures_;
    if (std::string id = attribute(node, "id"); !id.empty())
      by_id_.try_emplace(std::move(id), node);
    const std::string href = as_text(node->name) == "use" ? attribute(node, "href") : "";
    if (href.empty()) continue;
    if (xlink == nullptr) xlink = xmlNewNs(top, as_xml(xlink_namespace), as_xml("xlink"));
    if (xlink != nullptr) xmlSetNsProp(node, xlink, as_xml("href"), as_xml(href.c_str()));
  }
  prepare_root();
}

bool SvgDocument::apply_styles() {
  SvgStyleSheet sheet;
  xmlNode* const top = root();
  const auto is_element = [](const xmlNode* node) { return node->type == XML_ELEMENT_NODE; };
  for (xmlNode* node = top; node != nullptr; node = next_node(node, top, true)) {
    if (!is_element(node) || as_text(node->name) != "style") continue;
    const std::string type = attribute(node, "type"), media = attribute(node, "media");
    const bool for_screens = media.empty() || media.find("all") != std::string::npos ||
                             media.find("screen") != std::string::npos;
    if (!for_screens || !(type.empty() || type == "text/css")) continue;
    const XmlText text(xmlNodeGetContent(node), xmlFree);
    sheet.add(as_text(text.get()));
  }
  selectors_left_out_ = sheet.left_out();
  if (sheet.empty()) return true;
  std::size_t tried = 0;
  for (xmlNode* node = top; node != nullptr; node = next_node(node, top, true)) {
    if (!is_element(node)) continue;
    const std::string style = sheet.style_of(node, tried);
    if (tried > SvgStyleSheet::most_tries) return false;
    if (!style.empty()) xmlSetProp(node, as_xml("style"), as_xml(style.c_str()));
  }
  return true;
}

void SvgDocument::find_unit() {
  for (const char* name : {"width", "height"}) {
    const std::string value = attribute(root(), name);
    std::string_view unit = value;
    if (!take_number(unit)) continue;
    if (unit.starts_with("in")) unit_ = Unit::inch;
    for (const char* metric : {"mm", "cm", "Q", "pt", "pc"})
      if (unit.starts_with(metric)) unit_ = Unit::millimetre;
  }
}

void SvgDocument::prepare_root() {
  find_unit();
  xmlNode* const top = root();
  const std::string box = attribute(top, "viewBox");
  std::string_view rest = box;
  std::array<double, 4> numbers{};
  for (double& number : numbers) {
    const std::optional<double> taken = take_number(rest);
    if (!taken) return;
    number = *taken;
  }
  if (!(numbers[2] > 0) || !(numbers[3] > 0)) return;
  const std::array<const char*, 2> names{"width", "height"};
  std::array<std::string, 2> values;
  std::array<bool, 2> given{};
  for (std::size_t i = 0; i < 2; ++i) {
    values[i] = attribute(top, names[i]);
    std::string_view text = values[i];
    given[i] = take_number(text).has_value() && !text.starts_with('%');
  }
  const auto set = [&](std::size_t i, const std::string& value) {
    xmlSetProp(top, as_xml(names[i]), as_xml(value.c_str()));
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (given[i]) continue;
    const std::size_t other = 1 - i;
    if (!given[other]) {
      set(i, fmt::format("{}", numbers[2 + i]));
      continue;
    }
    std::string_view unit = values[other];
    const double length = take_number(unit).value_or(0);
    set(i, fmt::format("{}{}", length * (numbers[2 + i] / numbers[2 + other]), unit));
  }
}

}  // namespace medial::io

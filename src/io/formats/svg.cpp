#include "io/formats/svg.h"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <array>
#include <cmath>
#include <numbers>

// The grammars of attributes are compiled in svg_grammars.cpp: both files need half the memory
// then.
#define SVGPP_USE_EXTERNAL_PATH_DATA_PARSER
#define SVGPP_USE_EXTERNAL_TRANSFORM_PARSER
#define SVGPP_USE_EXTERNAL_PAINT_PARSER
#define SVGPP_USE_EXTERNAL_LENGTH_PARSER
#define SVGPP_USE_EXTERNAL_MISC_PARSER
#define SVGPP_USE_EXTERNAL_COLOR_PARSER
#define SVGPP_USE_EXTERNAL_PRESERVE_ASPECT_RATIO_PARSER
// libxml2 comes before svgpp's policy for it.
#include <svgpp/policy/xml/libxml2.hpp>
#include <svgpp/svgpp.hpp>

#include "io/formats/svg_document.h"
#include "io/formats/svg_path.h"
#include "medial/document.h"

namespace medial::io {

namespace {

namespace tag = svgpp::tag;
namespace mpl = boost::mpl;

// What a document may unfold to through `use`, however deeply nested: a document can ask for a
// billion copies in a kilobyte.
constexpr std::uint64_t most_copies = 1'000'000;   // elements
constexpr std::uint64_t most_copied = 10'000'000;  // control points
constexpr int deepest = 400;                       // elements inside elements, copies included

/// Thrown inside this file only, and caught in read_svg().
struct Refused {
  Error error;
};

[[noreturn]] void refuse(ErrorCode code, std::string text) {
  throw Refused{{code, std::move(text), {}}};
}

/// What is gathered while the document is walked.
struct Drawing {
  const SvgDocument& document;
  Document<Feature> dataset;
  bool loose = false;
  std::uint64_t copies = 0;
  std::uint64_t copied_points = 0;
  std::uint64_t unfilled = 0;
  std::vector<Contour> strokes = {};  ///< closed ones, while nothing is filled
};

/// The context that svgpp fills for every element; what is inherited is copied from the parent.
class Element : public SvgPath {
 public:
  using length_factory_type = svgpp::factory::length::unitless<>;

  explicit Element(Drawing& drawing) : drawing_(drawing) {
    const double unit = millimetres(Unit::css_pixel) / millimetres(drawing.document.unit());
    apply({{unit, 0}, {0, unit}, {}});
  }
  Element(Element& parent, const xmlNode* node)
      : drawing_(parent.drawing_),
        transform_(parent.transform_),
        lengths_(parent.lengths_),
        filled_(parent.filled_),
        even_odd_(parent.even_odd_),
        visible_(parent.visible_),
        displayed_(parent.displayed_),
        copied_(parent.copied_),
        depth_(parent.depth_ + 1),
        reference_size_(parent.size_for_child_),
        node_(node) {
    if (depth_ > deepest) {
      refuse(
          ErrorCode::unsupported,
          fmt::format("elements are nested more than {} deep, copies by 'use' included", deepest));
    }
    if (copied_ && ++drawing_.copies > most_copies) {
      refuse(ErrorCode::too_large,
             fmt::format("'use' expands to more than {} elements", most_copies));
    }
  }

  void on_exit_element();

  // Lengths and viewports.
  const length_factory_type& length_factory() const { return lengths_; }
  void set_viewport(double x, double y, double width, double height) {
    lengths_.set_viewport_size(width, height);
    if (depth_ > 0) apply({{1, 0}, {0, 1}, {x, y}});
  }
  void set_viewbox_size(double width, double height) { lengths_.set_viewport_size(width, height); }
  void set_viewbox_transform(double dx, double dy, double sx, double sy, bool) {
    apply({{sx, 0}, {0, sy}, {dx, dy}});
    if (depth_ == 1) remove_rounding();
  }
  void get_reference_viewport_size(double& width, double& height) {
    if (reference_size_[0]) width = *reference_size_[0];
    if (reference_size_[1]) height = *reference_size_[1];
  }
  void disable_rendering() { displayed_ = false; }
  void transform_matrix(const boost::array<double, 6>& m) {
    apply({{m[0], m[1]}, {m[2], m[3]}, {m[4], m[5]}});
  }

  // Properties.
  template <class... Values>
  void set(tag::attribute::fill, const Values&...) {
    filled_ = true;
  }
  void set(tag::attribute::fill, tag::value::none) { filled_ = false; }
  void set(tag::attribute::fill, tag::value::inherit) {}
  template <class Iri>
  void set(tag::attribute::fill, const Iri&, tag::value::none) {
    filled_ = true;
  }
  void set(tag::attribute::fill_rule, tag::value::evenodd) { even_odd_ = true; }
  void set(tag::attribute::fill_rule, tag::value::nonzero) { even_odd_ = false; }
  void set(tag::attribute::fill_rule, tag::value::inherit) {}
  template <class Value>
  void set(tag::attribute::display, Value) {}
  void set(tag::attribute::display, tag::value::none) { displayed_ = false; }
  template <class Value>
  void set(tag::attribute::visibility, Value) {
    visible_ = false;
  }
  void set(tag::attribute::visibility, tag::value::visible) { visible_ = true; }
  void set(tag::attribute::visibility, tag::value::inherit) {}

  // Copies by `use`.
  template <class Text>
  void set(tag::attribute::xlink::href, tag::iri_fragment, const Text& text) {
    target_.assign(boost::begin(text), boost::end(text));
  }
  template <class Text>
  void set(tag::attribute::xlink::href, const Text&) {}  // another file
  void set(tag::attribute::x, double x) { place_.x = x; }
  void set(tag::attribute::y, double y) { place_.y = y; }
  void set(tag::attribute::width, double width) { use_size_[0] = width; }
  void set(tag::attribute::height, double height) { use_size_[1] = height; }

  void path_exit() {
    is_path_ = true;
    if (!copied_) return;
    drawing_.copied_points += step_count();
    if (drawing_.copied_points > most_copied)
      refuse(ErrorCode::too_large,
             fmt::format("'use' expands to more than {} points", most_copied));
  }

 private:
  void apply(const Affine& inner) { transform_ = transform_ * inner; }
  /// A drawing in units of its own size, as most are, has these coordinates without loss.
  void remove_rounding() {
    constexpr double rounding = 1e-14;
    for (double* factor : {&transform_.x.x, &transform_.y.y})
      if (std::fabs(*factor - 1) < rounding) *factor = 1;
  }
  void add_feature();
  void draw_copy();

  Drawing& drawing_;
  Affine transform_;
  length_factory_type lengths_;
  bool filled_ = true;
  bool even_odd_ = false;
  bool visible_ = true;
  bool displayed_ = true;
  bool copied_ = false;  ///< inside of a copy by `use`
  int depth_ = 0;
  /// Width and height of a `use`, for the element that it copies.
  std::array<std::optional<double>, 2> reference_size_{};
  std::array<std::optional<double>, 2> size_for_child_{};

  const xmlNode* node_ = nullptr;
  Vec2 place_;
  std::array<std::optional<double>, 2> use_size_{};
  std::string target_;
  bool is_path_ = false;
};

void Element::add_feature() {
  if (!displayed_ || !visible_) return;
  if (!filled_ && !drawing_.loose) {
    ++drawing_.unfilled;
    if (!drawing_.dataset.items.empty()) return;
    for (Contour& contour : contours(transform_, RingRole::any, false, true)) {
      if (contour.open && contour.points.front() != contour.points.back()) continue;
      contour.open = false;
      drawing_.strokes.push_back(std::move(contour));
    }
    return;
  }
  Feature feature;
  feature.contours = contours(transform_, even_odd_ ? RingRole::any : RingRole::winding,
                              drawing_.loose, drawing_.loose && !filled_);
  if (feature.contours.empty()) return;
  feature.filled = true;
  feature.id = static_cast<std::int64_t>(drawing_.dataset.items.size());
  if (std::string id = attribute(node_, "id"); !id.empty()) {
    feature.attributes.emplace_back("id", std::move(id));
  }
  drawing_.dataset.items.push_back(std::move(feature));
}

void Element::on_exit_element() {
  if (is_path_) add_feature();
  if (!target_.empty() && displayed_) draw_copy();
}

// What svgpp reads. Everything else is passed over: text, images, gradients, clipping
// paths, masks, patterns, markers, and definitions unless they are used.
using Shapes =
    mpl::set<tag::element::path, tag::element::rect, tag::element::circle, tag::element::ellipse,
             tag::element::line, tag::element::polyline, tag::element::polygon>::type;
using Groups = mpl::set<tag::element::svg, tag::element::g, tag::element::a, tag::element::switch_,
                        tag::element::use_>::type;
using Processed = mpl::fold<Shapes, Groups, mpl::insert<mpl::_1, mpl::_2>>::type;
using Copied = mpl::insert<Processed, tag::element::symbol>::type;
using ParsedAttributes =
    mpl::fold<mpl::protect<mpl::joint_view<svgpp::traits::shapes_attributes_by_element,
                                           svgpp::traits::viewport_attributes>>,
              mpl::set<tag::attribute::transform, tag::attribute::fill, tag::attribute::fill_rule,
                       tag::attribute::display, tag::attribute::visibility,
                       mpl::pair<tag::element::use_, tag::attribute::xlink::href>>::type,
              mpl::insert<mpl::_1, mpl::_2>>::type;

struct Contexts {
  template <class Parent, class Tag>
  struct apply {
    using type = svgpp::factory::context::on_stack_with_xml_element<Element>;
  };
};

/// Unknown elements and styles are passed over, as browsers do; shapes that cannot be read are
/// refused.
struct Errors {
  using context_type = Element;
  using intercepted_exception_type = Refused;

  template <class... Arguments>
  static bool unknown_element(const Arguments&...) {
    return true;
  }
  template <class... Arguments>
  static bool unknown_attribute(const Arguments&...) {
    return true;
  }
  template <class... Arguments>
  static bool unexpected_attribute(const Arguments&...) {
    return true;
  }
  template <class... Arguments>
  static bool unexpected_element(const Arguments&...) {
    return true;
  }
  template <class Context, class Attribute>
  [[noreturn]] static bool required_attribute_not_found(const Context&, Attribute) {
    refuse(ErrorCode::malformed, fmt::format("the attribute '{}' is missing", name<Attribute>()));
  }
  template <class Context, class Attribute, class Value>
  static bool parse_failed(const Context&, Attribute, const Value&) {
    constexpr bool is_style = svgpp::traits::is_presentation_attribute<Attribute>::value;
    if constexpr (is_style) return true;
    refuse(ErrorCode::malformed,
           fmt::format("the attribute '{}' cannot be understood", name<Attribute>()));
  }
  template <class Context, class Attribute>
  [[noreturn]] static bool negative_value(const Context&, Attribute) {
    refuse(ErrorCode::malformed, fmt::format("the attribute '{}' is negative", name<Attribute>()));
  }
  static bool add_element_info(Refused& refused, const xmlNode* node) {
    if (!refused.error.place.line) refused.error.place.line = line_of(node);
    throw;
  }

 private:
  template <class Attribute>
  static std::string name() {
    return svgpp::attribute_name<char>::get<Attribute>();
  }
};

/// svgpp asks for the size of a `use` through a wrapper of the context.
struct Viewports : svgpp::policy::viewport_events::forward_to_method<Element> {
  template <class Wrapper>
  static void get_reference_viewport_size(const Wrapper& context, double& width, double& height) {
    using Unwrap = svgpp::detail::unwrap_context<Wrapper, tag::viewport_events_policy>;
    Unwrap::get(context).get_reference_viewport_size(width, height);
  }
};

// svgpp's own choice for paths is absolute coordinates without shorthands, for transformations one
// matrix.
static_assert(svgpp::policy::path::default_policy::no_cubic_bezier_shorthand &&
              svgpp::policy::transform::default_policy::join_transforms);
using Traversal = svgpp::document_traversal<
    svgpp::context_factories<Contexts>, svgpp::processed_elements<Processed>,
    svgpp::processed_attributes<ParsedAttributes>, svgpp::error_policy<Errors>,
    svgpp::viewport_policy<svgpp::policy::viewport::calculate>,
    svgpp::viewport_events_policy<Viewports>,
    svgpp::length_policy<
        svgpp::policy::length::forward_to_method<Element, const Element::length_factory_type>>>;

void Element::draw_copy() {
  xmlNode* const target = drawing_.document.find(target_);
  if (target == nullptr) return;
  Element copy = *this;
  copy.target_.clear();
  copy.copied_ = true;
  copy.size_for_child_ = use_size_;
  copy.apply({{1, 0}, {0, 1}, place_});
  Traversal::load_referenced_element<svgpp::referencing_element<tag::element::use_>,
                                     svgpp::expected_elements<svgpp::traits::reusable_elements>,
                                     svgpp::processed_elements<Copied>>::load(target, copy);
}

}  // namespace

Result<Document<Feature>> read_svg(const Input& input, const ReadOptions& options) {
  TextSource& source = *input.source;
  const Result<SvgDocument> document = SvgDocument::read(source);
  if (!document) return document.error();
  Drawing drawing{*document, {}, options.loose};
  const auto error = [&source](Error problem) {
    problem.place.file = source.error(problem.code, {}).place.file;
    return problem;
  };
  try {
    Element outermost(drawing);
    Traversal::load_document(document->root(), outermost);
  } catch (const Refused& refused) {
    return error(refused.error);
  }
  Document<Feature>& dataset = drawing.dataset;
  dataset.corner_angle = drawn_corner_angle;
  dataset.y_down = true;
  dataset.text_attributes = {"id"};
  dataset.unit = document->unit();
  if (dataset.items.empty() && !drawing.strokes.empty()) {
    dataset.notes.push_back(
        "no shape is filled: closed strokes are used as outlines, by the even-odd rule");
    drawing.unfilled = 0;
    Feature outlines;
    outlines.contours = std::move(drawing.strokes);
    outlines.filled = true;
    dataset.items.push_back(std::move(outlines));
  }
  if (dataset.items.empty()) {
    return error(
        {ErrorCode::empty,
         drawing.unfilled > 0
             ? "no shape is filled, and a stroke alone has no inside: give closed paths a fill"
             : "there is no filled shape; text and images are not read: convert text to paths",
         {}});
  }
  if (drawing.unfilled > 0) {
    dataset.notes.push_back(
        drawing.unfilled == 1
            ? std::string("1 shape is not filled and was left out")
            : fmt::format("{} shapes are not filled and were left out", drawing.unfilled));
  }
  if (const std::size_t count = document->texts_and_pictures(); count > 0) {
    dataset.notes.push_back(fmt::format("{} left out: convert texts to paths",
                                        count == 1
                                            ? std::string("1 text or picture was")
                                            : fmt::format("{} texts or pictures were", count)));
  }
  if (document->selectors_left_out() > 0) {
    const std::size_t count = document->selectors_left_out();
    dataset.notes.push_back(
        count == 1 ? std::string("1 unsupported selector of a style sheet was ignored")
                   : fmt::format("{} unsupported selectors of style sheets were ignored", count));
  }
  return std::move(dataset);
}

}  // namespace medial::io

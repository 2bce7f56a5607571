#pragma once

#include <libxml/tree.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

#include "io/text_source.h"
#include "medial/document.h"
#include "medial/error.h"

namespace medial::io {

/// A parsed document of SVG, made ready for svgpp: elements without a namespace are SVG's, `href`
/// is `xlink:href`, shapes without extent (which paint nothing) are gone, what style sheets say
/// stands in `style` attributes (SvgStyleSheet), and the outermost width and height are given where
/// a viewBox gives them.
///
/// Entities are short texts without references, so that a document unfolds to a constant times its
/// size at most; nothing outside of the document is ever read.
class SvgDocument {
 public:
  /// Errors: unreadable, malformed, too_large (2 GiB or more, or rules of style for too many
  /// elements).
  static Result<SvgDocument> read(TextSource& source);

  xmlNode* root() const { return xmlDocGetRootElement(document_.get()); }
  /// The element with an `id`; null if there is none.
  xmlNode* find(const std::string& id) const;
  /// The unit of the outermost width and height where they are physical lengths; otherwise pixels.
  Unit unit() const { return unit_; }
  /// How many selectors of style sheets were of other kinds.
  std::size_t selectors_left_out() const { return selectors_left_out_; }
  /// How many texts and pictures it shows, which are not read.
  std::size_t texts_and_pictures() const { return texts_and_pictures_; }

 private:
  struct Free {
    void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
  };
  void prepare();
  /// False where it would take too long.
  bool apply_styles();
  void prepare_root();
  void find_unit();

  std::unique_ptr<xmlDoc, Free> document_;
  std::unordered_map<std::string, xmlNode*> by_id_;
  std::size_t selectors_left_out_ = 0;
  std::size_t texts_and_pictures_ = 0;
  Unit unit_ = Unit::css_pixel;
};

/// The value of an attribute without a namespace; empty if it is missing.
std::string attribute(const xmlNode* node, const char* name);

/// The line of an element, from 1.
std::uint64_t line_of(const xmlNode* node);

}  // namespace medial::io

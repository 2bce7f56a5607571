#include "io/image_kind.h"

#include <cctype>

#include "io/ros_map_keys.h"
#include "io/text_source.h"
#include "medial/io/read.h"

namespace medial::io {

bool begins_like_pnm(std::string_view text) {
  return text.size() > 2 && text[0] == 'P' &&
         (text[1] == '1' || text[1] == '2' || text[1] == '4' || text[1] == '5') &&
         (text[2] == '#' || std::isspace(static_cast<unsigned char>(text[2])));
}

bool begins_like_raster(std::string_view text) {
  using namespace std::string_view_literals;
  return text.starts_with("\x89PNG\r\n\x1a\n"sv) || text.starts_with("II*\0"sv) ||
         text.starts_with("MM\0*"sv) || text.starts_with("II+\0"sv) ||
         text.starts_with("MM\0+"sv) || text.starts_with("\xff\xd8\xff"sv) ||
         text.starts_with("GIF8"sv) ||
         (text.starts_with("BM"sv) && text.size() > 9 && text.substr(6, 4) == "\0\0\0\0"sv) ||
         (text.starts_with("RIFF"sv) && text.size() > 11 && text.substr(8, 4) == "WEBP"sv);
}

bool begins_like_image(std::string_view text) {
  return begins_like_pnm(text) || begins_like_raster(text);
}

bool is_image(const std::string& path) {
  const Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
  return source && (is_ros_map(path) || begins_like_image((*source)->lookahead(image_sniffed)));
}

}  // namespace medial::io

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "medial/error.h"

namespace medial::io {

/// A text read from its beginning to its end through a window of constant size, so that files of
/// any length take no memory. Decompresses gzip by itself. Knows its line.
///
/// A failure to read (or to decompress) looks like the end of the text; failure() has it.
class TextSource {
 public:
  /// The longest number, in characters.
  static constexpr std::size_t longest_number = 4096;

  /// Opens a file; `-` is standard input. What can be read only once, such as a pipe, is one source
  /// until the end of its Reading: what one reader peeks at, the next one finds.
  static Result<std::shared_ptr<TextSource>> open(const std::string& path);

  /// While a file is read, and not only peeked at. Afterwards, whatever was found in it, its path
  /// is opened again, except for standard input.
  class Reading {
   public:
    explicit Reading(std::string path) : path_(std::move(path)) {}
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    std::string path_;
  };

  /// A text in memory.
  static std::shared_ptr<TextSource> of(std::string_view text);

  ~TextSource();
  TextSource(const TextSource&) = delete;
  TextSource& operator=(const TextSource&) = delete;

  /// The next character, or -1 at the end.
  int peek() {
    if (next_ == end_ && !refill(1)) return -1;
    return static_cast<unsigned char>(*next_);
  }
  /// Goes past the next character. Requires peek() != -1.
  void skip() {
    if (*next_ == '\n') ++line_;
    ++next_;
  }
  /// The next `count` characters, or fewer at the end. Requires count <= the window.
  std::string_view lookahead(std::size_t count) {
    if (available() < count) refill(count);
    return {next_, available() < count ? available() : count};
  }
  /// Goes past blanks, tabs and ends of lines.
  void skip_space();
  /// Appends all that is left to `text`, but stops soon after `limit` characters.
  void read_all(std::string& text, std::size_t limit);
  /// Whether this is all there is, as of a pipe: no file that can be opened again by its path.
  bool is_stream() const { return is_stream_; }
  /// The length of the file if that is known and the file is not compressed; otherwise 0.
  std::size_t length_hint() const;

  enum class Number : std::uint8_t { read, none, not_finite, too_long };
  /// Reads a decimal number, correctly rounded. An overflowing exponent or the words nan and inf
  /// are `not_finite`; without `read` the cursor stays.
  Number read_number(double& value);

  /// Line of the cursor, from 1.
  std::uint64_t line() const { return line_; }
  /// What went wrong while reading, if anything did.
  const std::optional<Error>& failure() const { return failure_; }
  /// An error at the cursor's line; or the failure to read that lies behind it.
  Error error(ErrorCode code, std::string text) const;
  /// How the next character is called in an error's text: 'x', "end of line", "the end".
  std::string next_as_text();

 private:
  struct Handle;
  class Streams;
  TextSource(std::string path, std::unique_ptr<Handle> handle, std::size_t window);
  std::size_t available() const { return static_cast<std::size_t>(end_ - next_); }
  bool refill(std::size_t wanted);

  std::string path_;
  std::unique_ptr<Handle> handle_;
  std::unique_ptr<char[]> window_;  ///< without initial values: a small file touches little of it
  std::size_t window_size_;
  const char* next_ = nullptr;
  const char* end_ = nullptr;
  std::uint64_t line_ = 1;
  bool at_end_ = false;
  std::optional<Error> failure_;
  bool is_stream_ = true;
};

}  // namespace medial::io

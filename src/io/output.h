#pragma once

#include <signal.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/compat.h"
#include "medial/error.h"
#include "medial/io/write.h"

namespace medial::io {

/// While one lives, no signal ends the program by way of remove_partial_files(): a handler does not
/// run in this thread, and waits in others. So a file comes with all of its companions.
class Uninterrupted {
 public:
  Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
  ~Uninterrupted();

 private:
  sigset_t before_{};
};

/// Where temporary files go. Errors: unwritable.
Result<std::string> temporary_folder();

/// Of layers for a file that another program has made or changed while they grew.
Error changed_meanwhile();

/// A new file that appears under its name all at once. It grows in a hidden directory beside the
/// target, under the target's own file name (which some formats want), with whatever companions the
/// format has; commit() moves everything to its place. Without commit() nothing remains. What a
/// killed process left is removed by the next one that writes beside it: a lock says whether the
/// owner of a hidden directory lives.
class PendingFile {
 public:
  /// Errors: unwritable.
  static Result<PendingFile> create(const std::string& target);
  ~PendingFile();
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;

  /// Where to write.
  const std::string& path() const { return path_; }
  /// Where it will be: symbolic links are resolved.
  const std::string& target() const { return target_; }
  /// Moves the file and its companions to the target; what they replace passes its permissions and,
  /// where that is allowed, its owner on. Errors: unwritable.
  Status commit();
  /// Moves the file to the target unless one has come there meanwhile. Errors: unwritable.
  Status commit_new();

 private:
  PendingFile() = default;
  std::string target_;     ///< symbolic links resolved
  std::string directory_;  ///< the hidden one; empty: nothing to clean up
  std::string path_;
  int lock_ = -1;  ///< a descriptor that keeps the directory locked
  int slot_ = -1;  ///< in the table that remove_partial_files() reads
};

/// Whether a path names something that cannot be replaced, only written to: a device or a pipe.
bool is_stream(const std::string& path);

/// A long text in pieces, so that it grows without being copied.
struct TextPiece {
  std::unique_ptr<char[]> bytes;
  std::size_t size;

  std::string_view text() const { return {bytes.get(), size}; }
};
using TextPieces = std::vector<TextPiece>;

/// A buffered stream of bytes to a file. After a failure everything is swallowed and finish()
/// reports it.
class OutputStream {
 public:
  /// Creates a file; `-` is standard output; a device or a pipe is opened as it is.
  static Result<OutputStream> open(const std::string& path);
  /// To the end of a text, which must outlive it.
  static OutputStream to(std::string& text);
  static OutputStream to(TextPieces& text);
  ~OutputStream();
  OutputStream(OutputStream&& other) noexcept;
  OutputStream& operator=(OutputStream&&) = delete;

  void put(char c) {
    if (used_ == buffer_size) flush();
    buffer_[used_++] = c;
  }
  void put(std::string_view text);
  /// The shortest decimal number that reads back as the same double. Where it is not finite,
  /// finish() fails.
  void put(double value) {
    finite_ = finite_ && std::isfinite(value);
    // Quarters, as pixels and many drawings have: their digits are at hand. Longer ones may be
    // shorter with an exponent.
    if (const double quarters = 4 * value; std::abs(value) < 1e5 &&
                                           quarters == std::trunc(quarters) &&
                                           (value != 0 || !std::signbit(value)))
      return put_quarters(static_cast<int>(quarters));
#ifdef __cpp_lib_to_chars
    put_chars(value);
#else
    put(std::string_view(shortest_text(value)));
#endif
  }
  template <class Integer>
  requires std::is_integral_v<Integer> &&
      (!std::is_same_v<Integer, char>)&&(!std::is_same_v<Integer, bool>)void put(Integer value) {
    put_chars(value);
  }
  bool failed() const { return problem_ != 0; }
  /// Writes what is left and closes. Errors: unwritable, internal (a number was not finite).
  Status finish();

 private:
  static constexpr std::size_t longest_number = 40, buffer_size = std::size_t{1} << 20;
  OutputStream(std::string path, int descriptor, bool owned);
  template <class Number>
  void put_chars(Number value) {
    if (buffer_size - used_ < longest_number) flush();
    char* const begin = buffer_.get();
    used_ = static_cast<std::size_t>(std::to_chars(begin + used_, begin + buffer_size, value).ptr -
                                     begin);
  }
  void put_quarters(int quarters) {
    if (quarters < 0) put('-');
    const unsigned size = static_cast<unsigned>(quarters < 0 ? -quarters : quarters);
    put_chars(size / 4);
    constexpr std::array<std::string_view, 4> rest{"", ".25", ".5", ".75"};
    if (size % 4 != 0) put(rest[size % 4]);
  }
  void flush();
  void write(const char* data, std::size_t count);

  std::string path_;
  std::string* text_ = nullptr;   ///< in place of a file
  TextPieces* pieces_ = nullptr;  ///< likewise
  int descriptor_ = -1;
  bool owned_ = false;
  int problem_ = 0;  ///< errno of the first failure
  bool finite_ = true;
  std::unique_ptr<char[]> buffer_;  ///< of buffer_size; of a short text few pages are touched
  std::size_t used_ = 0;
};

/// A text as a JSON string; bytes that are no UTF-8 are replaced.
std::string json_quoted(const std::string& text);
void put_quoted(OutputStream& out, std::string_view text);

/// Writes a file all at once, or to a stream or a text: `write` puts the bytes. Exceptions become
/// errors, and errors name the file.
Status write_whole(const Destination& target, const std::function<Status(OutputStream&)>& write);

}  // namespace medial::io

#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "medial/error.h"

namespace medial::io {

/// A new file that appears under its name all at once. It grows in a hidden directory beside the
/// target, under the target's own file name (which some formats want), with whatever companions the
/// format has; commit() moves everything to its place. Without commit() nothing remains.
class PendingFile {
 public:
  /// Errors: unwritable.
  static Result<PendingFile> create(const std::string& target);
  ~PendingFile();
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;

  /// Where to write.
  const std::string& path() const { return path_; }
  /// Moves the file and its companions to the target. Errors: unwritable.
  Status commit();

 private:
  PendingFile() = default;
  std::string target_;     ///< symbolic links resolved
  std::string directory_;  ///< the hidden one; empty: nothing to clean up
  std::string path_;
  int slot_ = -1;  ///< in the table that remove_partial_files() reads
};

/// Whether a path names something that cannot be replaced, only written to: a device or a pipe.
bool is_stream(const std::string& path);

/// A buffered stream of bytes to a file. After a failure everything is swallowed and finish()
/// reports it.
class OutputStream {
 public:
  /// Creates a file; `-` is standard output; a device or a pipe is opened as it is.
  static Result<OutputStream> open(const std::string& path);
  ~OutputStream();
  OutputStream(OutputStream&& other) noexcept;
  OutputStream& operator=(OutputStream&&) = delete;

  void put(char c) {
    if (used_ == buffer_.size()) flush();
    buffer_[used_++] = c;
  }
  void put(std::string_view text);
  /// The shortest decimal number that reads back as the same double. Where it is not finite,
  /// finish() fails.
  void put(double value) {
    finite_ = finite_ && std::isfinite(value);
    reserve(longest_number);
    used_ = static_cast<std::size_t>(
        std::to_chars(buffer_.data() + used_, buffer_.data() + buffer_.size(), value).ptr -
        buffer_.data());
  }
  template <class Integer>
  requires std::is_integral_v<Integer> &&
      (!std::is_same_v<Integer, char>)&&(!std::is_same_v<Integer, bool>)void put(Integer value) {
    reserve(longest_number);
    used_ = static_cast<std::size_t>(
        std::to_chars(buffer_.data() + used_, buffer_.data() + buffer_.size(), value).ptr -
        buffer_.data());
  }
  bool failed() const { return problem_ != 0; }
  /// Writes what is left and closes. Errors: unwritable, internal (a number was not finite).
  Status finish();

 private:
  static constexpr std::size_t longest_number = 40;
  OutputStream(std::string path, int descriptor, bool owned);
  void reserve(std::size_t count) {
    if (buffer_.size() - used_ < count) flush();
  }
  void flush();
  void write(const char* data, std::size_t count);

  std::string path_;
  int descriptor_ = -1;
  bool owned_ = false;
  int problem_ = 0;  ///< errno of the first failure
  bool finite_ = true;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

/// A text as a JSON string; bytes that are no UTF-8 are replaced.
std::string json_quoted(const std::string& text);
void put_quoted(OutputStream& out, std::string_view text);

/// Writes a file all at once, or to a stream: `write` puts the bytes. Exceptions become errors, and
/// errors name the file.
Status write_whole(const std::string& path, const std::function<Status(OutputStream&)>& write);

}  // namespace medial::io

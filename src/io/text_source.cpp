#include "io/text_source.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>

#include "base/compat.h"
#include "io/place.h"

namespace medial::io {

namespace {

constexpr std::size_t file_window = std::size_t{1} << 18;

}  // namespace

struct TextSource::Handle {
  gzFile file = nullptr;
  ~Handle() {
    if (file != nullptr) gzclose(file);
  }
};

/// The streams that have been opened, but not read.
class TextSource::Streams {
 public:
  static Streams& all() {
    static Streams streams;
    return streams;
  }
  std::shared_ptr<TextSource> find(const std::string& path) {
    const std::lock_guard lock(mutex_);
    const auto found = sources_.find(path);
    return found == sources_.end() ? nullptr : found->second;
  }
  void add(const std::string& path, std::shared_ptr<TextSource> source) {
    const std::lock_guard lock(mutex_);
    sources_[path] = std::move(source);
  }
  void forget(const std::string& path) {
    const std::lock_guard lock(mutex_);
    sources_.erase(path);
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<TextSource>> sources_;
};

TextSource::TextSource(std::string path, std::unique_ptr<Handle> handle, std::size_t window)
    : path_(std::move(path)),
      handle_(std::move(handle)),
      window_(uninitialized<char[]>(window)),
      window_size_(window),
      next_(window_.get()),
      end_(next_) {}

TextSource::~TextSource() = default;

Result<std::shared_ptr<TextSource>> TextSource::open(const std::string& path) {
  const bool standard = path == "-";
  const auto failed = [&path] {
    return Error{ErrorCode::unreadable, std::string("cannot open: ") + std::strerror(errno),
                 in_file(path)};
  };
  struct stat status {};
  if (!standard && stat(path.c_str(), &status) != 0) return failed();
  if (S_ISDIR(status.st_mode))
    return Error{ErrorCode::unreadable, "this is a directory: name a file in it", in_file(path)};
  const bool is_stream = standard || !S_ISREG(status.st_mode);
  if (is_stream)
    if (auto known = Streams::all().find(path)) return known;
  auto handle = std::make_unique<Handle>();
  errno = 0;
  handle->file = standard ? gzdopen(dup(STDIN_FILENO), "rb") : gzopen(path.c_str(), "rb");
  if (handle->file == nullptr) return failed();
  gzbuffer(handle->file, unsigned{1} << 17);

  std::shared_ptr<TextSource> source(new TextSource(path, std::move(handle), file_window));
  source->is_stream_ = is_stream;
  if (source->lookahead(3) == "\xEF\xBB\xBF") source->next_ += 3;  // the byte order mark of UTF-8
  if (is_stream) Streams::all().add(path, source);
  return source;
}

TextSource::Reading::~Reading() {
  if (path_ != "-") Streams::all().forget(path_);
}

std::shared_ptr<TextSource> TextSource::of(std::string_view text) {
  std::shared_ptr<TextSource> source(new TextSource({}, nullptr, text.size()));
  source->end_ = std::copy(text.begin(), text.end(), source->window_.get());
  source->at_end_ = true;
  return source;
}

bool TextSource::refill(std::size_t wanted) {
  if (at_end_) return available() >= wanted;
  std::size_t kept = available();
  std::memmove(window_.get(), next_, kept);
  next_ = window_.get();
  while (kept < wanted && !at_end_) {
    const auto room = static_cast<unsigned>(window_size_ - kept);
    const int got = gzread(handle_->file, window_.get() + kept, room);
    if (got > 0) kept += static_cast<std::size_t>(got);
    if (got < static_cast<int>(room)) {
      int code = Z_OK;
      const char* message = gzerror(handle_->file, &code);
      if (code == Z_ERRNO) {
        failure_ = Error{ErrorCode::unreadable, std::string("cannot read: ") + std::strerror(errno),
                         in_file(path_)};
      } else if (code == Z_BUF_ERROR) {
        failure_ = Error{ErrorCode::malformed, "the gzip data end too early", in_file(path_)};
      } else if (code != Z_OK && code != Z_STREAM_END) {
        failure_ = Error{ErrorCode::malformed,
                         fmt::format("the gzip data are damaged: {}", message), in_file(path_)};
      }
      if (got <= 0 || failure_) at_end_ = true;
    }
  }
  end_ = window_.get() + kept;
  return kept >= wanted;
}

void TextSource::skip_space() {
  while (true) {
    while (next_ != end_ && (*next_ == ' ' || (*next_ >= '\t' && *next_ <= '\r'))) skip();
    if (next_ != end_ || !refill(1)) return;
  }
}

std::size_t TextSource::length_hint() const {
  if (handle_ == nullptr) return available();
  struct stat status {};
  const bool plain = gzdirect(handle_->file) != 0;
  if (!plain || stat(path_.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return 0;
  return static_cast<std::size_t>(status.st_size);
}

void TextSource::read_all(std::string& text, std::size_t limit) {
  while (text.size() <= limit && (available() > 0 || refill(1))) {
    text.append(next_, available());
    next_ = end_;
  }
}

TextSource::Number TextSource::read_number(double& value) {
  if (available() < longest_number) refill(longest_number);
  const char* start = next_;
  if (start != end_ && *start == '+') {
    ++start;  // which from_chars does not take
    if (start != end_ && *start == '-') return Number::none;
  }
  const auto [stop, problem] = fast_float::from_chars(start, end_, value);
  if (problem == std::errc::invalid_argument) return Number::none;
  if (static_cast<std::size_t>(stop - next_) >= longest_number) return Number::too_long;
  if (!std::isfinite(value)) return Number::not_finite;
  next_ = stop;
  return Number::read;
}

Error TextSource::error(ErrorCode code, std::string text) const {
  if (failure_) return *failure_;
  Error result{code, std::move(text), in_file(path_)};
  result.place.line = line_;
  return result;
}

std::string TextSource::next_as_text() {
  const int next = peek();
  if (next < 0) return "the end";
  if (next == '\n' || next == '\r') return "the end of the line";
  if (next > ' ' && next < 127) return fmt::format("'{}'", static_cast<char>(next));
  return fmt::format("the byte {:#04x}", next);
}

}  // namespace medial::io

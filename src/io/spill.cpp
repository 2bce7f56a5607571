#include "io/spill.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace medial::io {

namespace {

constexpr std::size_t block = std::size_t{1} << 18;

/// A new file without a name; -1 with errno.
int open_nameless(const std::string& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
#endif
  std::string name = folder + "/.medial-XXXXXX";
  const int named = ::mkstemp(name.data());
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

/// Calls transfer(done) until all bytes of a block are done; errno, or 0.
template <class Transfer>
int transfer_block(const Transfer& transfer) {
  for (std::size_t done = 0; done < block;) {
    const ssize_t count = transfer(done);
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else if (count == 0 || errno != EINTR)
      return count == 0 ? EIO : errno;
  }
  return 0;
}

}  // namespace

Spill::Spill(std::string folder, std::size_t kinds) : folder_(std::move(folder)), kinds_(kinds) {}

Spill::~Spill() {
  if (file_ >= 0) ::close(file_);
}

void Spill::clear() {
  for (Kind& kind : kinds_) kind = {};
  end_ = 0;
}

void Spill::fail(int problem) {
  if (status_)
    status_ = Error{ErrorCode::unwritable,
                    std::string("cannot write a temporary file: ") + std::strerror(problem),
                    {}};
}

void Spill::put(std::size_t kind, std::string_view bytes) {
  Kind& own = kinds_[kind];
  while (!bytes.empty()) {
    const std::string_view taken = bytes.substr(0, block - own.waiting.size());
    own.waiting += taken;
    bytes.remove_prefix(taken.size());
    if (own.waiting.size() == block) write_block(own);
  }
}

void Spill::write_block(Kind& kind) {
  if (file_ < 0 && status_) {
    file_ = open_nameless(folder_);
    if (file_ < 0) fail(errno);
  }
  if (status_) {
    const int problem = transfer_block([&](std::size_t done) {
      return ::pwrite(file_, kind.waiting.data() + done, block - done,
                      static_cast<off_t>(end_ + done));
    });
    if (problem != 0) fail(problem);
  }
  kind.blocks.push_back(end_);
  kind.waiting.clear();
  end_ += block;
}

Status Spill::read(std::size_t kind, const std::function<void(std::string_view)>& use) {
  const Kind& own = kinds_[kind];
  std::string text(block, '\0');
  for (const std::uint64_t begin : own.blocks) {
    if (!status_) break;
    const int problem = transfer_block([&](std::size_t done) {
      return ::pread(file_, text.data() + done, block - done, static_cast<off_t>(begin + done));
    });
    if (problem != 0) fail(problem);
    if (status_) use(text);
  }
  if (status_) use(own.waiting);
  return status_;
}

}  // namespace medial::io

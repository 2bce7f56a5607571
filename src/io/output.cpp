#include "io/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/format_name.h"
#include "io/guarded.h"
#include "io/place.h"
#include "medial/io/write.h"

namespace medial::io {

namespace {

namespace fs = std::filesystem;

Error unwritable(const std::string& path, int problem) {
  return Error{ErrorCode::unwritable, fmt::format("cannot write: {}", std::strerror(problem)),
               in_file(path)};
}

// What remove_partial_files() has to remove. A signal handler must not allocate, lock or list
// directories, so every name that can occur in a hidden directory is spelled out beforehand, each
// ended by a NUL, the directory last.
constexpr int slots = 16;
std::array<std::atomic<const char*>, slots> g_partial{};

// The companions of a shapefile and of a database, by what replaces or follows the extension.
constexpr std::array<std::string_view, 5> siblings{".shx", ".dbf", ".prj", ".cpg", ".shp"};
constexpr std::array<std::string_view, 3> tails{"-journal", "-wal", "-shm"};

/// The names for one hidden directory: each ends with a NUL, and the last is empty.
std::string partial_names(const std::string& path, const std::string& directory) {
  std::string names = path + '\0';
  for (const std::string_view tail : tails) (names += path).append(tail) += '\0';
  const std::string stem = (fs::path(directory) / fs::path(path).stem()).string();
  for (const std::string_view sibling : siblings) (names += stem).append(sibling) += '\0';
  return names + directory + '\0';
}

int remember(const std::string& names) {
  char* copy = new char[names.size() + 1];
  std::memcpy(copy, names.c_str(), names.size() + 1);
  for (int slot = 0; slot < slots; ++slot) {
    const char* free = nullptr;
    if (g_partial[static_cast<std::size_t>(slot)].compare_exchange_strong(free, copy)) return slot;
  }
  delete[] copy;  // more writes at once than slots: the signal handler will not know this one
  return -1;
}

void forget(int slot) {
  if (slot >= 0) delete[] g_partial[static_cast<std::size_t>(slot)].exchange(nullptr);
}

std::atomic<int> g_commits = 0;

/// The file that a path leads to through symbolic links, which may lead to none.
Result<fs::path> through_links(const std::string& path) {
  fs::path resolved = path;
  std::error_code code;
  for (int links = 0; fs::is_symlink(resolved, code); ++links) {
    if (links == 40) return unwritable(path, ELOOP);
    resolved = resolved.parent_path() / fs::read_symlink(resolved, code);  // or that, if absolute
    if (code) return unwritable(path, code.value());
  }
  return resolved;
}

/// The mode of hidden folders. The sticky bit, which has no other use where nobody else may write,
/// marks them as medial's: a user's own folder of that name is never removed.
constexpr mode_t hidden_mode = S_ISVTX | S_IRWXU;

/// Locks a hidden folder. The descriptor that holds the lock; or -1 with errno: EWOULDBLOCK where a
/// process that lives holds it, ENOENT where there is no such folder any more, EPERM where it is
/// not one that medial has made for this user.
int lock_folder(const std::string& folder) {
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0) return -1;
  const auto problem = [&]() -> int {
    struct stat locked {
    }, there{};
    if (flock(lock, LOCK_EX | LOCK_NB) != 0 || fstat(lock, &locked) != 0 ||
        lstat(folder.c_str(), &there) != 0)
      return errno;
    if (locked.st_ino != there.st_ino || locked.st_dev != there.st_dev) return ENOENT;
    return locked.st_uid == geteuid() && (locked.st_mode & 07777U) == hidden_mode ? 0 : EPERM;
  }();
  if (problem == 0) return lock;
  ::close(lock);
  errno = problem;
  return -1;
}

/// Removes a hidden folder that a process of this machine left when it was killed; whether it did.
bool remove_dead_folder(const std::string& folder) {
  const int lock = lock_folder(folder);
  if (lock < 0) return false;
  std::error_code code;
  fs::remove_all(folder, code);
  ::close(lock);
  return !code;
}

/// How the names of hidden folders begin. Locks of other machines may not be known here.
std::string folder_prefix() {
  std::array<char, 256> machine{};
  gethostname(machine.data(), machine.size() - 1);
  std::ranges::replace(machine, '/', '-');
  return fmt::format(".medial-{}-", machine.data());
}

struct HiddenFolder {
  std::string path;
  int lock;  ///< a descriptor, as long as the folder is in use; -1 where folders cannot be locked
};

/// Makes the first hidden folder in `parent` that nobody uses. Nothing with errno: impossible.
std::optional<HiddenFolder> make_hidden_folder(const fs::path& parent) {
  const std::string prefix = (parent / folder_prefix()).string();
  for (int number = 0;;) {
    const std::string path = prefix + std::to_string(number);
    if (mkdir(path.c_str(), hidden_mode) == 0) {
      const int lock = lock_folder(path);
      if (lock >= 0) return HiddenFolder{path, lock};
      if (const int problem = errno;
          problem == EMFILE || problem == ENFILE || problem == ENOMEM) {  // others could lock it
        rmdir(path.c_str());
        errno = problem;
        return std::nullopt;
      }
      if (errno != EWOULDBLOCK && errno != ENOENT) return HiddenFolder{path, -1};
      ++number;  // another process took it for a dead one
    } else if (errno != EEXIST) {
      return std::nullopt;
    } else if (!remove_dead_folder(path)) {
      ++number;
    }
  }
}

/// Gives a new file the permissions, and if it may the owner, of the one that it replaces.
void inherit_permissions(const fs::path& file, const fs::path& replaced) {
  struct stat status {};
  if (stat(replaced.c_str(), &status) != 0) return;
  if (chown(file.c_str(), status.st_uid, status.st_gid) != 0) status.st_mode &= 0777U;
  static_cast<void>(chmod(file.c_str(), status.st_mode & 07777U));
}

}  // namespace

Uninterrupted::Uninterrupted() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before_);
  ++g_commits;
}

Uninterrupted::~Uninterrupted() {
  --g_commits;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void remove_partial_files() noexcept {
  const int saved = errno;
  while (g_commits.load() > 0) sched_yield();
  for (auto& slot : g_partial) {
    const char* name = slot.exchange(nullptr);
    if (name == nullptr) continue;
    for (; *name != '\0'; name += std::strlen(name) + 1) {
      if (unlink(name) != 0) rmdir(name);
    }
  }
  errno = saved;
}

Result<PendingFile> PendingFile::create(const std::string& target) {
  std::error_code code;
  PendingFile file;
  auto link_end = through_links(target);
  if (!link_end) return std::move(link_end).error();
  const fs::path& resolved = *link_end;
  if (!resolved.has_filename() || fs::is_directory(resolved, code))
    return unwritable(target, EISDIR);
  file.target_ = resolved.string();
  const fs::path parent = resolved.has_parent_path() ? resolved.parent_path() : fs::path(".");
  const Uninterrupted uninterrupted;
  const auto folder = make_hidden_folder(parent);
  if (!folder) return unwritable(target, errno);
  file.directory_ = folder->path;
  file.lock_ = folder->lock;
  file.path_ = (fs::path(file.directory_) / resolved.filename()).string();
  file.slot_ = remember(partial_names(file.path_, file.directory_));
  return file;
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : target_(std::move(other.target_)),
      directory_(std::exchange(other.directory_, {})),
      path_(std::move(other.path_)),
      lock_(std::exchange(other.lock_, -1)),
      slot_(std::exchange(other.slot_, -1)) {}

PendingFile::~PendingFile() {
  if (directory_.empty()) return;
  const Uninterrupted uninterrupted;  // once it is gone, another process may make one of that name
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
  forget(slot_);
  if (lock_ >= 0) ::close(lock_);
}

Status PendingFile::commit() {
  std::error_code code;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(directory_, code), end; !code && entry != end;
       entry.increment(code)) {
    files.push_back(entry->path());
  }
  if (code) return unwritable(target_, code.value());
  // The named file last, once its companions are there. Some libraries write its extension in lower
  // case.
  const auto is_named = [named = lower_case(path_)](const fs::path& file) {
    return lower_case(file.string()) == named;
  };
  std::partition(files.begin(), files.end(), std::not_fn(is_named));
  const auto place_of = [&](const fs::path& file) {
    return is_named(file) ? fs::path(target_) : fs::path(target_).replace_filename(file.filename());
  };
  // Before the first file is replaced: else old and new companions would be mixed.
  for (const fs::path& file : files)
    if (fs::is_directory(place_of(file), code)) return unwritable(target_, EISDIR);
  const Uninterrupted uninterrupted;
  for (const fs::path& file : files) {
    const fs::path place = place_of(file);
    inherit_permissions(file, place);
    fs::rename(file, place, code);
    if (code) return unwritable(target_, code.value());
  }
  return success();
}

Status PendingFile::commit_new() {
  const Uninterrupted uninterrupted;
  std::error_code code;
  fs::create_hard_link(path_, target_, code);
  if (!code) return success();  // the other name goes with the directory
  if (fs::exists(target_, code)) return changed_meanwhile();
  return commit();  // a file system without links: one that comes now is replaced
}

Result<std::string> temporary_folder() {
  std::error_code code;
  const fs::path folder = fs::temp_directory_path(code);
  if (!code) return folder.string();
  return Error{
      ErrorCode::unwritable,
      fmt::format("there is no folder for temporary files ({}); set TMPDIR to one", code.message()),
      {}};
}

Error changed_meanwhile() {
  return Error{ErrorCode::unwritable,
               "another program has changed the file meanwhile, so nothing was added; run this "
               "again",
               {}};
}

bool is_stream(const std::string& path) {
  struct stat status {};
  return path == "-" ||
         (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode));
}

Result<OutputStream> OutputStream::open(const std::string& path) {
  if (path == "-") return OutputStream(path, STDOUT_FILENO, false);
  const int flags = is_stream(path) ? O_WRONLY : O_WRONLY | O_CREAT | O_TRUNC;
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) return unwritable(path, errno);
  return OutputStream(path, descriptor, true);
}

OutputStream OutputStream::to(std::string& text) {
  OutputStream out({}, -1, false);
  out.text_ = &text;
  return out;
}

OutputStream OutputStream::to(TextPieces& text) {
  OutputStream out({}, -1, false);
  out.pieces_ = &text;
  return out;
}

OutputStream::OutputStream(std::string path, int descriptor, bool owned)
    : path_(std::move(path)),
      descriptor_(descriptor),
      owned_(owned),
      buffer_(new char[buffer_size]) {}

OutputStream::OutputStream(OutputStream&& other) noexcept
    : path_(std::move(other.path_)),
      text_(other.text_),
      pieces_(other.pieces_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      owned_(std::exchange(other.owned_, false)),
      problem_(other.problem_),
      finite_(other.finite_),
      buffer_(std::move(other.buffer_)),
      used_(std::exchange(other.used_, 0)) {}

OutputStream::~OutputStream() {
  if (owned_) ::close(descriptor_);
}

void OutputStream::put(std::string_view text) {
  if (buffer_size - used_ < text.size()) {
    flush();
    if (text.size() > buffer_size) {
      write(text.data(), text.size());
      return;
    }
  }
  std::copy(text.begin(), text.end(), buffer_.get() + used_);
  used_ += text.size();
}

void OutputStream::flush() {
  if (used_ == 0) return;
  if (pieces_ != nullptr) {
    pieces_->push_back({std::move(buffer_), used_});
    buffer_.reset(new char[buffer_size]);
  } else {
    write(buffer_.get(), used_);
  }
  used_ = 0;
}

void OutputStream::write(const char* data, std::size_t count) {
  if (text_ != nullptr) {
    text_->append(data, count);
    return;
  }
  if (pieces_ != nullptr) {
    pieces_->push_back({std::unique_ptr<char[]>(new char[count]), count});
    std::copy(data, data + count, pieces_->back().bytes.get());
    return;
  }
  while (count > 0 && problem_ == 0) {
    const ssize_t written = ::write(descriptor_, data, count);
    if (written < 0) {
      if (errno != EINTR) problem_ = errno;
      continue;
    }
    data += written;
    count -= static_cast<std::size_t>(written);
  }
}

Status OutputStream::finish() {
  flush();
  if (owned_) {
    owned_ = false;
    if (::close(descriptor_) != 0 && problem_ == 0) problem_ = errno;
  }
  if (problem_ != 0) return unwritable(path_, problem_);
  if (!finite_) return Error{ErrorCode::internal, "a number of the result is not finite", {}};
  return success();
}

std::string json_quoted(const std::string& text) {
  using Json = nlohmann::json;
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

Status write_whole(const Destination& target, const std::function<Status(OutputStream&)>& write) {
  const std::string& path = target.path;
  const auto put = [&](Result<OutputStream> out) -> Status {
    if (!out) return std::move(out).error();
    Status written = write(*out);
    if (!written) return written;
    return out->finish();
  };
  const auto to = [&put](const std::string& where) { return put(OutputStream::open(where)); };
  const auto run = [&]() -> Status {
    if (target.text != nullptr) return put(OutputStream::to(*target.text));
    if (is_stream(path)) return to(path);
    Result<PendingFile> pending = PendingFile::create(path);
    if (!pending) return std::move(pending).error();
    Status written = to(pending->path());
    if (!written) return written;
    return pending->commit();
  };
  return guarded(path, run);
}

Status write_text(const std::string& path, const std::string& text) {
  return write_whole(path, [&text](OutputStream& out) -> Status {
    out.put(std::string_view(text));
    return success();
  });
}

void put_quoted(OutputStream& out, std::string_view text) {
  const bool plain = std::ranges::all_of(
      text, [](char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; });
  if (!plain) return out.put(std::string_view(json_quoted(std::string(text))));
  out.put('"');
  out.put(text);
  out.put('"');
}

}  // namespace medial::io

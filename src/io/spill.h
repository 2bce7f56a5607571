#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "medial/error.h"

namespace medial::io {

/// Bytes of several kinds that come in turns and leave kind by kind: in a file without a name,
/// which is gone with the program.
class Spill {
 public:
  Spill(std::string folder, std::size_t kinds);
  Spill(const Spill&) = delete;
  Spill& operator=(const Spill&) = delete;
  ~Spill();

  void put(std::size_t kind, std::string_view bytes);
  /// Calls use(bytes) with all of a kind, in order. Errors: unwritable, also that of put().
  Status read(std::size_t kind, const std::function<void(std::string_view)>& use);
  /// Forgets all.
  void clear();
  const Status& status() const { return status_; }

 private:
  struct Kind {
    std::string waiting;                ///< less than a block
    std::vector<std::uint64_t> blocks;  ///< where they begin in the file
  };
  void write_block(Kind& kind);
  void fail(int problem);

  std::string folder_;
  std::vector<Kind> kinds_;
  int file_ = -1;
  std::uint64_t end_ = 0;
  Status status_ = success();
};

}  // namespace medial::io

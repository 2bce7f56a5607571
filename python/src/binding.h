#pragma once

// Shared by all bindings: arrays without copies, errors as exceptions, work without the
// interpreter's lock.

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "medial/medial.h"

namespace medial::python {

namespace nb = nanobind;

template <class T>
using Values = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Coordinates = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
template <class T, std::size_t dimensions = 1>
using Array = nb::ndarray<nb::numpy, T, nb::ndim<dimensions>>;
using Bytes = Array<const std::uint8_t>;

template <class T>
std::span<const T> span_of(const Values<T>& values) {
  return {values.data(), values.shape(0)};
}
inline std::span<const Vec2> points_of(const Coordinates& coordinates) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  return {reinterpret_cast<const Vec2*>(coordinates.data()), coordinates.shape(0)};
}

/// The elements of a vector as bytes, which NumPy views as records; `owner` keeps them alive.
template <class T>
Bytes bytes_of(const std::vector<T>& values, nb::handle owner) {
  return Bytes(values.data(), {values.size() * sizeof(T)}, owner);
}

/// A vector, and the owner that keeps it alive for NumPy arrays.
template <class T>
std::pair<std::vector<T>&, nb::capsule> owned(std::vector<T> values) {
  auto* const kept = new std::vector<T>(std::move(values));
  const auto free = [](void* vector) noexcept { delete static_cast<std::vector<T>*>(vector); };
  return {*kept, nb::capsule(kept, free)};
}
/// A NumPy array that owns a vector: its elements, rows of `columns` elements, or its bytes.
template <class T>
Array<T> array_of(std::vector<T> values) {
  const auto [all, owner] = owned(std::move(values));
  return Array<T>(all.data(), {all.size()}, owner);
}
template <class T, class Row>
Array<T, 2> rows_of(std::vector<Row> rows) {
  const auto [all, owner] = owned(std::move(rows));
  return Array<T, 2>(reinterpret_cast<T*>(all.data()), {all.size(), sizeof(Row) / sizeof(T)},
                     owner);
}
template <class T>
Bytes records_of(std::vector<T> values) {
  const auto [all, owner] = owned(std::move(values));
  return bytes_of(all, owner);
}

/// An error to be raised in Python as a MedialError.
class Failure : public std::exception {
 public:
  explicit Failure(Error error) : error_(std::move(error)) {}
  const Error& error() const { return error_; }
  const char* what() const noexcept override { return error_.text.c_str(); }

 private:
  Error error_;
};

/// The value of a result; throws its error.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw Failure(std::move(result).error());
  return std::move(result).value();
}
[[noreturn]] inline void refuse(ErrorCode code, const char* text) {
  throw Failure(Error{code, text, {}});
}

/// Records from the bytes of an array. Errors: malformed.
template <class T>
std::vector<T> records_from(const Values<std::uint8_t>& bytes) {
  if (bytes.shape(0) % sizeof(T) != 0) refuse(ErrorCode::malformed, "an array has another layout");
  std::vector<T> records(bytes.shape(0) / sizeof(T));
  std::copy_n(bytes.data(), bytes.shape(0), reinterpret_cast<std::uint8_t*>(records.data()));
  return records;
}

/// The value of an option. Errors: TypeError, with its name.
template <class T>
T option_as(nb::handle value, const std::string& name) {
  try {
    return nb::cast<T>(value);
  } catch (const std::bad_cast&) {
    throw nb::type_error(("the value of '" + name + "' has the wrong type").c_str());
  }
}

/// The largest distance of lines from curves. Errors: invalid_option.
inline double positive_chord(double chord) {
  if (!(chord > 0)) refuse(ErrorCode::invalid_option, "chord is positive");
  return chord;
}

/// A length that may be 0. Errors: invalid_option.
inline double length_as(double length, const char* name) {
  if (!(length >= 0))
    throw Failure({ErrorCode::invalid_option, std::string(name) + " is a length, or 0", {}});
  return length;
}

/// Runs work() without the interpreter's lock.
template <class Work>
auto without_lock(const Work& work) {
  const nb::gil_scoped_release released;
  return work();
}

constexpr std::size_t long_work = 20'000;  ///< with more points, checks for interrupts
constexpr int most_threads = 1024;         ///< the limit of compute(), also for work on many shapes
constexpr int fine_work = 1000;            ///< with fewer points, one thread is as fast as several

/// Runs work(cancel) without the interpreter's lock. Large work runs in a thread of its own:
/// meanwhile this thread lets Python handle signals, and an interrupt cancels the work.
template <class Work>
auto run(std::size_t size, const Work& work) {
  std::atomic<bool> cancel{false};
  if (size < long_work) return without_lock([&] { return work(&cancel); });
  std::optional<decltype(work(&cancel))> result;
  std::exception_ptr thrown;
  bool interrupted = false;
  without_lock([&] {
    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
    std::thread worker([&] {
      try {
        result.emplace(work(&cancel));
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::scoped_lock lock(mutex);
      done = true;
      changed.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; })) {
      lock.unlock();
      if (!interrupted) {
        const nb::gil_scoped_acquire held;
        interrupted = PyErr_CheckSignals() != 0;
        if (interrupted) cancel = true;
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
  });
  if (interrupted) throw nb::python_error();
  if (thrown) std::rethrow_exception(thrown);
  return *std::move(result);
}

/// A shape that its axes share.
using SharedShape = std::shared_ptr<const Shape>;

/// A shape and its axis, or a part of it: pruned, cut or smoothed.
struct AxisOf {
  SharedShape shape;
  MedialAxis axis;
  bool part = false;

  /// Built by the first query; several threads may need it.
  const AxisLocator& locator() const {
    std::call_once(once_, [&] { locator_ = std::make_unique<AxisLocator>(axis); });
    return *locator_;
  }

  AxisOf(SharedShape own_shape, MedialAxis own_axis, bool is_part)
      : shape(std::move(own_shape)), axis(std::move(own_axis)), part(is_part) {}
  AxisOf(const AxisOf&) = delete;
  AxisOf& operator=(const AxisOf&) = delete;

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<AxisLocator> locator_;
};
struct ShapeOf {
  SharedShape shape;
};
/// A path along an axis.
struct PathOf {
  AxisPath path;
};

/// The tool paths of a shape, and those of an end mill that clears before a V.
struct CarvingOf {
  SharedShape shape;
  Carving carving, clearing;
};

inline std::unique_ptr<AxisOf> share(SharedShape shape, MedialAxis axis, bool part = false) {
  return std::make_unique<AxisOf>(std::move(shape), std::move(axis), part);
}

/// The options of compute() by their names in Python; those of the method are in `own`.
Options options_of(const std::string& method, double tolerance, double corner_angle, bool exact,
                   int threads, bool exterior, double margin, const nb::dict& own);
/// Rings of coordinates: ring i is [begin[i], begin[i + 1]); roles and bulges may be absent.
std::vector<Ring> rings_of(const Coordinates& coordinates,
                           const std::optional<Values<std::int64_t>>& begin,
                           const std::optional<Values<std::uint8_t>>& roles,
                           const std::optional<Values<double>>& bulges);

RepairRule repair_from(const std::optional<std::string>& name);
Route route_from(const std::string& name);
PruneMeasure measure_from(const std::string& name);
/// Appends polylines along all branches, within a chord or with steps, and the end of each.
void add_lines(const MedialAxis& axis, double chord, double step, std::vector<Disk>& disks,
               std::vector<std::int64_t>& begin);

/// Converts a code of shapes or images to its streams and back.
nb::list streams_of(const ShapeCode& code);
ShapeCode code_of(const std::vector<nb::bytes>& streams);

// Each function adds the functions and classes of its topic to the module.
void bind_shapes(nb::module_& module);
void bind_axes(nb::module_& module);
void bind_collections(nb::module_& module);
void bind_well_known_binary(nb::module_& module);
void bind_batches(nb::module_& module);
void bind_paths(nb::module_& module);
void bind_derived(nb::module_& module);
void bind_editing(nb::module_& module);
void bind_carving(nb::module_& module);
void bind_text(nb::module_& module);
void bind_features(nb::module_& module);
void bind_voronoi(nb::module_& module);
void bind_tiles(nb::module_& module);
void bind_images(nb::module_& module);
void bind_solids(nb::module_& module);

}  // namespace medial::python

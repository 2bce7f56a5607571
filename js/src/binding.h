#pragma once

// Shared by all bindings. JavaScript calls plain C functions: handles are pointers, options are
// text such as "order=2;exact=1", and an answer stays in tables of numbers and a text of JSON until
// the next call. A function that returns 0 has failed: the text is then the error.

#include <concepts>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "medial/medial.h"

#define MEDIAL_JS extern "C" __attribute__((used, visibility("default")))

namespace medial::js {

/// An error to be thrown in JavaScript as a MedialError.
struct Failure {
  Error error;
};
template <class T>
T value_of(Result<T> result) {
  if (!result) throw Failure{std::move(result).error()};
  return std::move(result).value();
}
[[noreturn]] inline void refuse(ErrorCode code, std::string text) {
  throw Failure{{code, std::move(text), {}}};
}

/// Writes JSON, member after member.
class Json {
 public:
  Json& add(std::string_view name, double value);
  Json& add(std::string_view name, std::string_view value);
  Json& add(std::string_view name, const char* value) { return add(name, std::string_view(value)); }
  Json& add(std::string_view name, bool value);
  Json& add(std::string_view name, const std::vector<std::string>& values);
  Json& add(std::string_view name, Vec2 p);
  std::string text() const { return text_ + "}"; }

 private:
  void begin(std::string_view name);
  std::string text_ = "{";
};

/// The results of the last call.
struct Answer {
  std::vector<std::vector<double>> tables;
  std::string text;
};
Answer& answer();
void answer_error(const Error& error);

/// Runs work(). An error becomes the answer, and the result is 0.
template <class Work>
auto answered(const Work& work) -> decltype(work()) {
  answer() = {};
  try {
    return work();
  } catch (const Failure& failure) {
    answer_error(failure.error);
  } catch (const std::bad_alloc&) {
    answer_error({ErrorCode::out_of_memory, "memory ran out", {}});
  } catch (const std::exception& exception) {
    answer_error({ErrorCode::internal, exception.what(), {}});
  }
  return {};
}

/// Options by name, taken one by one; unknown ones are refused.
class Named {
 public:
  explicit Named(const char* text);
  Named& take(std::string_view name, double& to);
  Named& take(std::string_view name, bool& to);
  Named& take(std::string_view name, std::string& to);
  template <std::integral Whole>
  Named& take(std::string_view name, Whole& to) {
    double value = -1;
    if (take_number(name, value)) to = whole<Whole>(name, value);
    return *this;
  }
  /// Separates elements by commas, like JavaScript's text of an array.
  template <std::size_t count>
  Named& take(std::string_view name, std::array<double, count>& to) {
    take_numbers(name, to);
    return *this;
  }
  template <class T>
  Named& take(std::string_view name, std::optional<T>& to) {
    if (has(name)) take(name, to.emplace());
    return *this;
  }
  void finish() const;

 private:
  bool take_number(std::string_view name, double& to);
  void take_numbers(std::string_view name, std::span<double> to);
  bool has(std::string_view name) const;
  template <class Whole>
  static Whole whole(std::string_view name, double value) {
    if (!(value >= 0 && value <= 4294967295.0) || value != static_cast<double>(Whole(value)))
      refuse(ErrorCode::invalid_option, std::string(name) + " is a whole number, not negative");
    return static_cast<Whole>(value);
  }
  std::vector<std::pair<std::string, std::string>> left_;
};

using SharedShape = std::shared_ptr<const Shape>;
struct ShapeOf {
  SharedShape shape;
  std::vector<Contour> contours = {};  ///< for methods that follow curves
};
struct AxisOf {
  SharedShape shape;
  MedialAxis axis;
  std::unique_ptr<AxisLocator> locator = {};  ///< built by the first query
};
struct PathOf {
  AxisPath path;
};

/// Counts, indices, kinds and addresses for tables.
template <class Count>
double number(Count count) {
  return static_cast<double>(count);
}
template <class T>
double address_of(const T* object) {
  return number(reinterpret_cast<std::uintptr_t>(object));
}

AxisOf* new_axis(SharedShape shape, MedialAxis axis);

/// Rows of numbers from a buffer of JavaScript.
inline std::span<const Vec2> points_at(const double* coordinates, std::size_t count) {
  static_assert(sizeof(Vec2) == 2 * sizeof(double));
  return {reinterpret_cast<const Vec2*>(coordinates), count};
}
/// Records that consist of doubles only, as a table of numbers.
template <class Row>
std::vector<double> table_of(std::span<const Row> rows) {
  const auto* const first = reinterpret_cast<const double*>(rows.data());
  return {first, first + rows.size() * (sizeof(Row) / sizeof(double))};
}
template <class Row>
std::vector<double> table_of(const std::vector<Row>& rows) {
  return table_of(std::span<const Row>(rows));
}

/// Rings of coordinates: ring i is [begin[i], begin[i + 1]); roles and bulges may be null.
std::vector<Ring> rings_from(const double* coordinates, const std::uint32_t* begin,
                             std::size_t count, const std::uint8_t* roles, const double* bulges);

}  // namespace medial::js

#pragma once

namespace medial {

/// A vector of the plane, for numbers that are no doubles or that know their errors.
template <class Number>
struct Vector {
  Number x, y;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector operator*(const Number& s, const Vector& a) { return {s * a.x, s * a.y}; }
};
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class Number>
Number cross(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace medial

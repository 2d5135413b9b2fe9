#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace walr::reference {

template <std::size_t N>
using Vector = std::array<double, N>;
template <std::size_t N>
using Matrix = std::array<Vector<N>, N>;

/// Inverse of a positive definite matrix, by Gauss-Jordan elimination.
template <std::size_t N>
Matrix<N> inverse(Matrix<N> a) {
  Matrix<N> b{};
  for (std::size_t i = 0; i < N; ++i) b[i][i] = 1.0;
  for (std::size_t k = 0; k < N; ++k) {
    const double pivot = a[k][k];
    for (std::size_t j = 0; j < N; ++j) {
      a[k][j] /= pivot;
      b[k][j] /= pivot;
    }
    for (std::size_t i = 0; i < N; ++i) {
      const double factor = a[i][k];
      for (std::size_t j = 0; i != k && j < N; ++j) {
        a[i][j] -= factor * a[k][j];
        b[i][j] -= factor * b[k][j];
      }
    }
  }
  return b;
}

template <std::size_t N>
double dot(const Vector<N>& a, const Vector<N>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

template <std::size_t N>
Vector<N> absolute(Vector<N> v) {
  for (double& x : v) x = std::abs(x);
  return v;
}

template <std::size_t N>
Vector<N> operator*(const Matrix<N>& m, const Vector<N>& v) {
  Vector<N> result{};
  for (std::size_t i = 0; i < N; ++i) result[i] = dot(m[i], v);
  return result;
}

}  // namespace walr::reference

// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/bspline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

namespace verge::fit {
namespace {

/// 0/0 := 0: a span of no length carries no weight.
double ratio(double numerator, double denominator) {
  return denominator > 0.0 ? numerator / denominator : 0.0;
}

/// Whether u lies in [t_i, t_{i+1}), or at the end of the last span that is not empty.
bool in_span(std::span<const double> t, std::size_t i, double u) {
  if (t[i] <= u && u < t[i + 1]) return true;
  return u == t.back() && t[i] < u && t[i + 1] == u;
}

struct Domain {
  double from;
  double to;
};

Domain domain(std::span<const double> t, std::size_t degree) { return {t[degree], t[t.size() - 1 - degree]}; }

/// The span [t_k, t_{k+1}) of the domain that holds u; at the domain's end the last that is not empty.
std::size_t span_of(std::span<const double> t, std::size_t degree, double u) {
  const auto interior = t.subspan(degree + 1, t.size() - 2 * (degree + 1));
  std::size_t k = degree + static_cast<std::size_t>(std::ranges::upper_bound(interior, u) - interior.begin());
  while (k > degree && t[k] == t[k + 1]) --k;
  return k;
}

/// The basis functions of span k at its parameter u. `degree`: a number, or one that the compiler knows.
template <class Degree>
BasisRow basis_row_in_span(std::span<const double> t, Degree degree, std::size_t k, double u) {
  BasisRow row{.first = k - degree};
  row.values[0] = 1.0;  // of order 1; the order grows by one a turn (Piegl and Tiller, algorithm A2.2)
  for (std::size_t order = 1; order <= degree; ++order) {
    double saved = 0.0;
    for (std::size_t r = 0; r < order; ++r) {
      const double right = t[k + r + 1] - u;
      const double left = u - t[k + 1 + r - order];
      const double share = ratio(row.values[r], right + left);
      row.values[r] = saved + right * share;
      saved = left * share;
    }
    row.values[order] = saved;
  }
  return row;
}

BasisRow basis_in_span(std::span<const double> t, std::size_t degree, std::size_t k, double u) {
  using Cubic = std::integral_constant<std::size_t, 3>;  // nearly all curves: its loops are unrolled
  return degree == Cubic{} ? basis_row_in_span(t, Cubic{}, k, u) : basis_row_in_span(t, degree, k, u);
}

constexpr int kPiecesForLength = 32;  // the length is then good to 1e-4 where one span bends by 90 degrees
constexpr int kPiecesForFeet = 16;    // only the start of an iteration

/// A dense polyline of the curve with the parameter and arc length at each of its points.
struct Table {
  std::vector<double> u;
  std::vector<Vec2> points;
  std::vector<double> s;
};

/// `pieces` chords a span.
Table tabulate(const BSpline& curve, int pieces) {
  Table table;
  const std::size_t most = curve.control_points.size() * static_cast<std::size_t>(pieces);
  table.u.reserve(most);
  table.points.reserve(most);
  table.s.reserve(most);
  const auto add = [&](double u, Vec2 p) {
    table.s.push_back(table.s.empty() ? 0.0 : table.s.back() + distance(table.points.back(), p));
    table.u.push_back(u);
    table.points.push_back(p);
  };
  const auto& t = curve.knots;
  add(t[curve.degree], evaluate(curve, t[curve.degree]));
  for (std::size_t k = curve.degree; k + 1 + curve.degree < t.size(); ++k) {
    if (t[k] == t[k + 1]) continue;
    for (int piece = 1; piece < pieces; ++piece) {
      const double u = t[k] + (t[k + 1] - t[k]) * piece / pieces;
      add(u, combine(basis_in_span(t, curve.degree, k, u), curve.degree, curve.control_points));
    }
    add(t[k + 1], evaluate(curve, t[k + 1]));
  }
  return table;
}

/// The value of `to` where `from`, ascending, has the value x: linear between the entries, constant beyond
/// them. `above`: the first entry of `from` that is not less than x.
double interpolated(std::span<const double> from, std::span<const double> to, double x, std::size_t above) {
  const std::size_t k = std::clamp(above, std::size_t{1}, from.size() - 1);
  const double share = std::clamp(ratio(x - from[k - 1], from[k] - from[k - 1]), 0.0, 1.0);
  return to[k - 1] + share * (to[k] - to[k - 1]);
}

/// The parameter of the polyline's point nearest to p. By segments and not by vertices: a stretch of the
/// curve that passes between two vertices close to p must not lose against one whose vertex happens to be
/// closer.
double nearest_on_polyline(const Table& table, Vec2 p) {
  double best_u = table.u.front();
  double best = std::numeric_limits<double>::infinity();
  const auto offer = [&](double squared, double u) {
    if (!(squared < best)) return;
    best = squared;
    best_u = u;
  };
  for (std::size_t k = 1; k < table.points.size(); ++k) {
    const Vec2 chord = table.points[k] - table.points[k - 1];
    const Vec2 offset = p - table.points[k - 1];
    const double along = dot(offset, chord);
    const double whole = dot(chord, chord);
    if (along <= 0.0) {
      offer(dot(offset, offset), table.u[k - 1]);
    } else if (along < whole) {  // beyond lies the next segment's first vertex
      const double share = along / whole;
      const Vec2 gap = offset - share * chord;
      offer(dot(gap, gap), table.u[k - 1] + share * (table.u[k] - table.u[k - 1]));
    }
  }
  const Vec2 last = p - table.points.back();
  offer(dot(last, last), table.u.back());
  return best_u;
}

/// Gauss-Newton on (C(u) - p) . C'(u) = 0 from u, until a step is too short to matter or does not come
/// nearer.
double refine(const BSpline& curve, const BSpline& tangent, Vec2 p, double u) {
  const Domain d = domain(curve.knots, curve.degree);
  const double shortest = 1e-10 * (d.to - d.from);
  Vec2 offset = p - evaluate(curve, u);
  constexpr int kSteps = 8;
  for (int i = 0; i < kSteps; ++i) {
    const Vec2 velocity = evaluate(tangent, u);
    const double next = std::clamp(u + ratio(dot(offset, velocity), dot(velocity, velocity)), d.from, d.to);
    if (std::abs(next - u) <= shortest) break;
    const Vec2 next_offset = p - evaluate(curve, next);
    if (!(dot(next_offset, next_offset) < dot(offset, offset))) break;
    u = next;
    offset = next_offset;
  }
  return u;
}

}  // namespace

double basis(std::span<const double> t, std::size_t i, std::size_t m, double u) {
  assert(m >= 1 && i + m < t.size());
  if (m == 1) return in_span(t, i, u) ? 1.0 : 0.0;
  return ratio(u - t[i], t[i + m - 1] - t[i]) * basis(t, i, m - 1, u) +
         ratio(t[i + m] - u, t[i + m] - t[i + 1]) * basis(t, i + 1, m - 1, u);
}

BasisRow basis_row(std::span<const double> t, std::size_t degree, double u) {
  assert(degree <= kMaxDegree && t.size() >= 2 * (degree + 1));
  const Domain d = domain(t, degree);
  u = std::clamp(u, d.from, d.to);
  return basis_in_span(t, degree, span_of(t, degree, u), u);
}

Vec2 evaluate(const BSpline& curve, double u) {
  return combine(basis_row(curve.knots, curve.degree, u), curve.degree, curve.control_points);
}

BSpline derivative(const BSpline& curve) {
  assert(curve.degree >= 1);
  const std::size_t p = curve.degree;
  BSpline out{.degree = p - 1, .knots{curve.knots.begin() + 1, curve.knots.end() - 1}, .control_points{}};
  for (std::size_t i = 0; i + 1 < curve.control_points.size(); ++i) {
    const double speed = ratio(static_cast<double>(p), curve.knots[i + p + 1] - curve.knots[i + 1]);
    out.control_points.push_back(speed * (curve.control_points[i + 1] - curve.control_points[i]));
  }
  return out;
}

std::vector<Vec2> sample(const BSpline& curve, double step_m) {
  assert(step_m > 0.0);
  const Table table = tabulate(curve, kPiecesForLength);
  const double total = table.s.back();
  if (total == 0.0) return {table.points.front()};
  constexpr double kSlack =
      1e-9;  // a length that rounding put just above a multiple of the step is that multiple
  const double pieces = std::max(1.0, std::ceil(total / step_m - kSlack));
  std::vector<Vec2> out{table.points.front()};
  std::size_t above = 0;
  for (std::size_t k = 1; k < static_cast<std::size_t>(pieces); ++k) {
    const double s = total * (static_cast<double>(k) / pieces);
    while (above < table.s.size() && table.s[above] < s) ++above;
    out.push_back(evaluate(curve, interpolated(table.s, table.u, s, above)));
  }
  out.push_back(table.points.back());
  return out;
}

std::vector<double> arc_lengths(const BSpline& curve, std::span<const double> parameters) {
  const Table table = tabulate(curve, kPiecesForLength);
  std::vector<double> s(parameters.size());
  std::ranges::transform(parameters, s.begin(), [&](double u) {
    const auto above = static_cast<std::size_t>(std::ranges::lower_bound(table.u, u) - table.u.begin());
    return interpolated(table.u, table.s, u, above);
  });
  return s;
}

double length(const BSpline& curve) { return tabulate(curve, kPiecesForLength).s.back(); }

std::vector<double> nearest_parameters(const BSpline& curve, std::span<const Vec2> points) {
  const Table table = tabulate(curve, kPiecesForFeet);
  const BSpline tangent = derivative(curve);
  std::vector<double> u;
  u.reserve(points.size());
  for (const Vec2 p : points) u.push_back(refine(curve, tangent, p, nearest_on_polyline(table, p)));
  return u;
}

std::array<double, 4> uniform_cubic_weights(double u, MatrixRow row) {
  const double first = row == MatrixRow::kCorrected ? 1.0 : 0.0;
  const double u2 = u * u;
  const double u3 = u2 * u;
  return {(-u3 + 3.0 * u2 - 3.0 * u + first) / 6.0, (3.0 * u3 - 6.0 * u2 + 4.0) / 6.0,
          (-3.0 * u3 + 3.0 * u2 + 3.0 * u + 1.0) / 6.0, u3 / 6.0};
}

Vec2 uniform_cubic(std::span<const Vec2, 4> p, double u, MatrixRow row) {
  const std::array<double, 4> w = uniform_cubic_weights(u, row);
  return w[0] * p[0] + w[1] * p[1] + w[2] * p[2] + w[3] * p[3];
}

}  // namespace verge::fit

// SPDX-License-Identifier: BSD-3-Clause
// The robot of tendon_robot.py by shooting: the equations of a tendon-driven rod in arc length
// (Rucker & Webster, IEEE Trans. Robotics 27, 2011; the backbone inextensible), classical
// Runge-Kutta steps, and Newton's method on the curvature at the base, its derivatives by
// differences. Prints, for each number of steps, the median time in seconds and the tip.
#include "measure.hpp"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <cstdio>

namespace {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

constexpr double length = 0.24, distance = 8e-3, radius = 0.4e-3, young = 210e9, poisson = 0.3;

struct Routed {
  Vec3 d, d1, d2;  ///< offset and its derivatives
};

struct Tendon {
  double tension, from, turn;  ///< [N]; angle at the base [rad], and what is added up to the tip

  Routed at(double s) const {
    const double ω = turn / length, φ = from + ω * s;
    const Vec3 d = distance * Vec3(std::cos(φ), std::sin(φ), 0);
    const Vec3 across = distance * Vec3(-std::sin(φ), std::cos(φ), 0);
    return {d, ω * across, -ω * ω * d};
  }
};

struct State {
  Vec3 r, u;
  Eigen::Vector4d q;  ///< x, y, z, w; not normalised between steps

  State moved(const State& rate, double h) const {
    return {r + h * rate.r, u + h * rate.u, q + h * rate.q};
  }
};

Mat3 cross(const Vec3& a) {
  Mat3 out;
  out << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return out;
}

struct Robot {
  std::array<Tendon, 4> tendons;
  Vec3 force;  ///< dead, at the tip
  Vec3 stiffness;

  /// Of backbone and tendons together, in the section's axes.
  Vec3 moment(double s, const Vec3& u) const {
    Vec3 m = stiffness.cwiseProduct(u);
    for (const auto& tendon : tendons) {
      const auto [d, d1, d2] = tendon.at(s);
      m += tendon.tension * d.cross((Vec3::UnitZ() + d1 + u.cross(d)).normalized());
    }
    return m;
  }

  State rate(double s, const State& at) const {
    const Eigen::Quaterniond q(at.q.normalized());
    Vec3 m = stiffness.cwiseProduct(at.u), given = Vec3::Zero();
    Mat3 k = stiffness.asDiagonal();
    for (const auto& tendon : tendons) {
      const auto [d, d1, d2] = tendon.at(s);
      const Vec3 v = Vec3::UnitZ() + d1 + at.u.cross(d);
      const double ℓ = v.norm(), T = tendon.tension;
      const Vec3 t = v / ℓ;
      const Mat3 across = (Mat3::Identity() - t * t.transpose()) / ℓ, D = cross(d);
      m += T * d.cross(t);
      given += T * (d1.cross(t) + D * across * (d2 + at.u.cross(d1)));
      k -= T * D * across * D;
    }
    const Vec3 change = m.cross(at.u) - Vec3::UnitZ().cross(q.conjugate() * force);
    const Eigen::Quaterniond spin(0, at.u.x(), at.u.y(), at.u.z());
    return {q * Vec3::UnitZ(), k.inverse() * (change - given),
            0.5 * (Eigen::Quaterniond(at.q) * spin).coeffs()};
  }

  State at_tip(const Vec3& u, int steps) const {
    State at{Vec3::Zero(), u, {0, 0, 0, 1}};
    const double h = length / steps;
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const State a = rate(s, at), b = rate(s + h / 2, at.moved(a, h / 2)),
                  c = rate(s + h / 2, at.moved(b, h / 2)), d = rate(s + h, at.moved(c, h));
      at = at.moved(a, h / 6).moved(b, h / 3).moved(c, h / 3).moved(d, h / 6);
    }
    return at;
  }

  /// From a straight robot.
  Vec3 tip(int steps) const {
    Vec3 u = Vec3::Zero();
    for (int iteration = 0; iteration < 50; ++iteration) {
      const State end = at_tip(u, steps);
      const Vec3 left = moment(length, end.u);
      Mat3 J;
      const double apart = 1e-6 / length;
      for (int i = 0; i < 3; ++i) {
        const Vec3 other = u + apart * Vec3::Unit(i);
        J.col(i) = (moment(length, at_tip(other, steps).u) - left) / apart;
      }
      const Vec3 step = J.inverse() * left;
      u -= step;
      if (step.norm() * length < 1e-9) return at_tip(u, steps).r;
    }
    return Vec3::Constant(NAN);
  }
};

}  // namespace

int main() {
  const double EI = young * M_PI * std::pow(radius, 4) / 4, GJ = EI / (1 + poisson);
  const double quarter = M_PI / 2;
  const Robot robot{
      {Tendon{4, 0, 0}, {1, quarter, 0}, {2, 2 * quarter, quarter}, {2, 3 * quarter, quarter}},
      {0, 0.05, 0},
      {EI, EI, GJ}};
  for (const int steps : {10, 20, 40, 80, 160, 320}) {
    Vec3 tip;
    const double time = pyrod::benchmark::seconds([&] { tip = robot.tip(steps); });
    std::printf("%d %.9f %.15f %.15f %.15f\n", steps, time, tip.x(), tip.y(), tip.z());
  }
}

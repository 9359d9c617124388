// SPDX-License-Identifier: BSD-3-Clause
/// \file How a solve ended, in a word and in a sentence.
#pragma once

#include <string_view>

namespace pyrod {

enum class Status {
  converged,
  out_of_iterations,
  stalled,
  not_finite,
  interrupted,
  too_coarse,
  taut,
  not_accurate
};

constexpr std::string_view name(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::out_of_iterations:
      return "out_of_iterations";
    case Status::stalled:
      return "stalled";
    case Status::not_finite:
      return "not_finite";
    case Status::interrupted:
      return "interrupted";
    case Status::too_coarse:
      return "too_coarse";
    case Status::taut:
      return "taut";
    case Status::not_accurate:
      return "not_accurate";
  }
  return "unknown";
}

/// What happened and what to try.
constexpr std::string_view advice(Status status) {
  switch (status) {
    case Status::converged:
      return "the last full Newton step was below the tolerance";
    case Status::out_of_iterations:
      return "max_iterations were used up: allow more, use more edges where the rod turns most, or "
             "apply the loads in steps, each started from the result before";
    case Status::stalled:
      return "no step along the search direction made progress: apply the loads in steps, each "
             "started from the result before; with dead moments in space there may be no "
             "equilibrium near";
    case Status::not_finite:
      return "numbers overflowed or became undefined: check the magnitudes of loads and "
             "stiffnesses, "
             "and use more edges if the rod turns by 2 pi or more from one edge to the next";
    case Status::interrupted:
      return "stopped on request; the last iterate is kept";
    case Status::too_coarse:
      return "neighbouring edges came to differ by nearly half a turn or more, so that the shape "
             "means "
             "nothing: use more edges where the rod turns most";
    case Status::taut:
      return "a rod that cannot stretch is held at two points that are as far apart as the rod "
             "between them is long, so that no force holds it against loads across it, and none is "
             "told along it: give it a finite EA, let one of the supports slide, or bring them "
             "nearer";
    case Status::not_accurate:
      return "the error that was wanted was not reached; the errors that were are told";
  }
  return "";
}

}  // namespace pyrod

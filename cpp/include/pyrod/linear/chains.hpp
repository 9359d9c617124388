// SPDX-License-Identifier: BSD-3-Clause
/// \file The edges of all spans and the cells between them, in a row: how the residual and what is
/// told change with the state and the numbers there, and the transposes.
///
/// It is what there is most of. All that stands at supports, joints and ends are blocks, see
/// `ResidualMaps` and `ToldMaps`, which add to what is set here.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/at_state.hpp>
#include <pyrod/linear/cell_part.hpp>
#include <pyrod/linear/cells.hpp>
#include <pyrod/linear/edge_part.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/whole_cell.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pyrod {

template <class Space>
class Chains {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `at` must stay where it is. `sections`: section forces on all edges.
  Chains(const AtState<Space>& at, const EdgeColumns<Space>& columns,
         const std::vector<Point<Space>>& sections)
      : kinds_{at.state, at.numbers, at.told} {
    const auto& layout = at.layout;
    edges_.reserve(std::size_t(layout.edges()));
    cells_.reserve(edges_.capacity());
    for (int e = 0; e < layout.edges(); ++e)
      edges_.emplace_back(at.x.frames[e], sections[e], columns.compliance[e],
                          columns.lengths[e][0]);
    const Cells<Space> cells(layout, at.x);
    const auto add = [&](const auto& c) {
      const auto& grid = at.net.rods[c.rod].grid;
      const double before = grid.h(c.vertex > 0 ? c.vertex - 1 : grid.edges() - 1);
      cells_.emplace_back(c, before / (2 * c.length));
    };
    for (int p = 0; p < int(layout.spans().size()); ++p) {
      const auto& span = layout.spans()[p];
      strips_.push_back({layout.first_edge(p), layout.last_edge(p), int(cells_.size()),
                         at.told.vertex(span.rod, span.first),
                         span.block >= 0 ? at.state.gap(p) : -1});
      cells.for_each_inside(span, add);
    }
    cells.for_each_between([&](const auto& c) {
      between_.push_back(
          {c.edge_a, c.edge_b, c.stiffness, c.rest, at.told.vertex(c.rod, c.vertex)});
      add(c);
    });
    find_others();
  }

  /// Items of what is told that are not set here.
  const std::vector<int>& others() const { return others_; }

  /// Sets the residual of all edges, and adds to the gaps: of numbers, and of the section forces
  /// in `state`.
  void multiply(const Items<Space>& numbers, const Items<Space>& state,
                Items<Space>& residual) const {
    for (const auto& strip : strips_) {
      P gap = P::Zero();
      for (int e = strip.first; e <= strip.last; ++e) {
        const auto& edge = edges_[e];
        const double δh = numbers(0, kinds_.numbers.length(e));
        const P δb = edge.δb(point(state, kinds_.state.force(e))),
                δΓ = edge.δΓ(δb, point(numbers, kinds_.numbers.compliance(e)));
        set(residual, kinds_.state.turn(e),
            Turn(edge.moment(δb, δΓ, δh) - turn(numbers, kinds_.numbers.following(e)) -
                 spin_to_frame(edge.R, turn(numbers, kinds_.numbers.moment(e)))));
        if (strip.gap >= 0) gap -= edge.reach(Turn::Zero(), δΓ, δh);
        if (e > strip.first) visit(strip, e, [&](const auto& c) { c.multiply(numbers, residual); });
      }
      if (strip.gap >= 0) residual.col(strip.gap).template head<dim>() += gap;
    }
    for_each_between([&](const auto& c, const auto&) { c.multiply(numbers, residual); });
  }

  /// Sets what is told of edges and of the vertices between them, and adds to the energy.
  void tell(const Items<Space>& numbers, const Items<Space>& state, Items<Space>& told) const {
    double energy = 0;
    const auto tell_cell = [&](const auto& c) { energy += c.tell(numbers, state, told); };
    for (const auto& strip : strips_)
      for (int e = strip.first; e <= strip.last; ++e) {
        const auto& edge = edges_[e];
        const double δh = numbers(0, kinds_.numbers.length(e));
        const Turn φ = turn(state, kinds_.state.turn(e));
        const P δS = point(numbers, kinds_.numbers.compliance(e)),
                δb = edge.δb(point(state, kinds_.state.force(e))) + edge.δb_of_turn(φ),
                δΓ = edge.δΓ(δb, δS);
        set(told, kinds_.told.reach(e), edge.reach(φ, δΓ, δh));
        set(told, kinds_.told.strain(e), δΓ);
        energy += edge.energy(δb, δS, δh);
        if (e > strip.first) visit(strip, e, tell_cell);
      }
    for_each_between([&](const auto& c, const auto&) { tell_cell(c); });
    told(0, kinds_.told.energy()) += energy;
  }

  /// Adds to the turns and section forces of the state, from weights of what is told.
  void pull_told(const Items<Space>& told, Items<Space>& state) const {
    const double energy = told(0, kinds_.told.energy());
    const auto pull_cell = [&](const auto& c) { c.pull_told(told, energy, state); };
    for (const auto& strip : strips_)
      for (int e = strip.first; e <= strip.last; ++e) {
        const auto& edge = edges_[e];
        const P r = point(told, kinds_.told.reach(e)),
                δb = edge.of_force(r, point(told, kinds_.told.strain(e)), energy);
        state.col(kinds_.state.force(e)).template head<dim>() += edge.R * δb;
        state.col(kinds_.state.turn(e)).template head<spin>() += edge.of_turn(r, δb);
        if (e > strip.first) visit(strip, e, pull_cell);
      }
    for_each_between([&](const auto& c, const auto&) { pull_cell(c); });
  }

  /// Adds to the section forces in `state`, from the residual.
  void pull_forces(const Items<Space>& residual, Items<Space>& state) const {
    for (const auto& strip : strips_) {
      const P gap = gap_of(strip, residual);
      for (int e = strip.first; e <= strip.last; ++e) pull_force(e, residual, gap, state);
    }
  }

  /// Sets the numbers of edges and of cells between them, from the residual and weights of what is
  /// told; adds to the section forces in `state`, from the residual.
  void pull(const Items<Space>& residual, const Items<Space>& told, Items<Space>& numbers,
            Items<Space>& state) const {
    const double energy = told(0, kinds_.told.energy());
    const auto& items = kinds_.numbers;
    for (const auto& strip : strips_) {
      const P gap = gap_of(strip, residual);
      for (int e = strip.first; e <= strip.last; ++e) {
        const auto& edge = edges_[e];
        const Turn m = turn(residual, kinds_.state.turn(e));
        const P r = point(told, kinds_.told.reach(e)) - gap;
        pull_force(e, residual, gap, state);
        set(numbers, items.compliance(e),
            edge.of_compliance(m, r, point(told, kinds_.told.strain(e)), energy));
        set(numbers, items.moment(e), Turn(-spin_to_space(edge.R, m)));
        set(numbers, items.following(e), Turn(-m));
        set(numbers, items.length(e), Vec1(edge.of_length(m, r, energy)));
        if (e > strip.first) {
          visit(strip, e, [&](const auto& c) {
            add_lengths(e - 1, e, c.pull(residual, told, energy, numbers), numbers);
          });
        } else {
          set(numbers, items.stiffness(e), Turn(Turn::Zero()));
          set(numbers, items.rest(e), Turn(Turn::Zero()));
        }
      }
    }
    for_each_between([&](const auto& c, const CellPlace& at) {
      add_lengths(at.a, at.b, c.pull(residual, told, energy, numbers), numbers);
    });
  }

 private:
  using P = Point<Space>;
  using Turn = Spin<Space>;

  /// A span: its edges, and its cells, of which the first is at the start of its second edge.
  struct Strip {
    int first, last, cells, vertex, gap;
  };

  static P point(const Items<Space>& from, int i) { return detail::point<Space>(from, i); }
  static Turn turn(const Items<Space>& from, int i) { return detail::turn<Space>(from, i); }
  template <class Value>
  static void set(Items<Space>& out, int i, const Value& value) {
    detail::set<Space>(out, i, value);
  }

  /// The cell at the start of an edge of a span.
  template <class Use>
  void visit(const Strip& strip, int e, Use&& use) const {
    const CellPlace at{e - 1, e, kinds_.numbers.stiffness(e), kinds_.numbers.rest(e),
                       strip.vertex + e - strip.first};
    const auto number = std::size_t(strip.cells + e - strip.first - 1);
    use(WholeCell<Space>(kinds_, cells_[number], at, edges_[e - 1], edges_[e]));
  }

  /// Those between spans, which come last.
  template <class Use>
  void for_each_between(Use&& use) const {
    std::size_t number = cells_.size() - between_.size();
    for (const auto& at : between_)
      use(WholeCell<Space>(kinds_, cells_[number++], at, edges_[at.a], edges_[at.b]), at);
  }

  void find_others() {
    const auto& told = kinds_.told;
    std::vector<char> inside(std::size_t(told.vertices()), false);
    for (const auto& strip : strips_)
      std::fill_n(inside.begin() + strip.vertex + 1, strip.last - strip.first, true);
    for (const auto& at : between_) inside[std::size_t(at.vertex)] = true;
    for (int v = 0; v < told.vertices(); ++v)
      if (!inside[std::size_t(v)])
        for (const int i :
             {told.vertex_turn(v), told.curvature(v), told.moment(v), told.rotation(v)})
          others_.push_back(i);
    for (int i = told.reaction_force(0); i < told.count(); ++i) others_.push_back(i);
  }

  static P gap_of(const Strip& strip, const Items<Space>& residual) {
    return strip.gap >= 0 ? point(residual, strip.gap) : P(P::Zero());
  }

  void pull_force(int e, const Items<Space>& residual, const P& gap, Items<Space>& state) const {
    const auto& edge = edges_[e];
    const Turn m = turn(residual, kinds_.state.turn(e));
    state.col(kinds_.state.force(e)).template head<dim>() +=
        edge.R * (edge.of_force(m) + edge.of_force(-gap, P::Zero(), 0));
  }

  void add_lengths(int a, int b, const Vec2& lengths, Items<Space>& numbers) const {
    numbers(0, kinds_.numbers.length(a)) += lengths[0];
    numbers(0, kinds_.numbers.length(b)) += lengths[1];
  }

  typename WholeCell<Space>::Kinds kinds_;
  std::vector<EdgePart<Space>> edges_;
  std::vector<CellPart<Space>> cells_;
  std::vector<Strip> strips_;
  std::vector<CellPlace> between_;
  std::vector<int> others_;
};

}  // namespace pyrod

#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/compat.h"
#include "methods/disks/events.h"

namespace medial::disks {

/// A span with what ends its edge, as far as that is known.
struct Step {
  Span span;
  Event event{};
  double error = 0;  ///< how far the exact disk of the event may be
  bool is_proposed = false;
  bool is_certain = false;
  bool is_tie = false;      ///< the event's disk touches several sites
  bool joins_node = false;  ///< double is certain that it is one tie with the span's node
  /// Whether the event's disk is the node's: where ties are kept in a polygon, if it is known.
  std::optional<bool> is_node = {};
};

/// Steps in order. One of which only the span is known takes no more than that: a node may have a
/// hundred thousand of them.
class Steps {
 public:
  bool empty() const { return size() == 0; }
  std::size_t size() const { return spans_.size() + proposed_.size(); }
  void push_back(const Step& step) {
    if (step.is_proposed)
      proposed_.push_back({step, spans_.size()});
    else
      spans_.push_back(step.span);
  }
  Step pop_back() {
    Step last;
    if (!proposed_.empty() && proposed_.back().before == spans_.size()) {
      last = proposed_.back().step;
      proposed_.pop_back();
    } else {
      last.span = spans_.back();
      spans_.pop_back();
    }
    return last;
  }
  /// Adds steps; `steps` is empty then.
  void append(Steps& steps) {
    if (empty()) return std::swap(*this, steps);
    for (Proposed& one : steps.proposed_) one.before += spans_.size();
    spans_.insert(spans_.end(), steps.spans_.begin(), steps.spans_.end());
    proposed_.insert(proposed_.end(), steps.proposed_.begin(), steps.proposed_.end());
    steps.clear();
  }
  void clear() {
    spans_.clear();
    proposed_.clear();
  }

  /// The spans of all steps. Only while none is proposed.
  std::vector<Span>& spans() { return spans_; }
  /// Proposes what ends the edges of some spans: propose(step) says whether it does.
  template <class Propose>
  void propose(const Propose& propose) {
    std::size_t kept = 0;
    for (const Span& span : spans_) {
      Step step{span};
      if (propose(step))
        proposed_.push_back({step, kept});
      else
        spans_[kept++] = span;
    }
    spans_.resize(kept);
  }
  bool are_certain() const {
    return ranges::all_of(proposed_, [](const Proposed& one) { return one.step.is_certain; });
  }
  void set_node(std::uint32_t node) {
    for (Span& span : spans_) span.node = node;
    for (Proposed& one : proposed_) one.step.span.node = node;
  }
  template <class Use>
  void for_each(const Use& use) const {
    auto next = proposed_.begin();
    for (std::size_t i = 0;; ++i) {
      for (; next != proposed_.end() && next->before == i; ++next) use(next->step);
      if (i == spans_.size()) return;
      use(Step{spans_[i]});
    }
  }

 private:
  struct Proposed {
    Step step;
    std::size_t before;  ///< how many of the spans come before it
  };
  std::vector<Span> spans_;  ///< of the steps of which nothing else is known
  std::vector<Proposed> proposed_;
};

}  // namespace medial::disks

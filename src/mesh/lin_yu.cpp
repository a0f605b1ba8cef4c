#include "mesh/lin_yu.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace relievo {

namespace {

constexpr std::uint32_t none = 0xffffffff;

// At a dead end this many vertices are looked at, most recently touched first: they are likely to lie beside what is cached in
// other machines' larger caches. One alone costs 0.1 % more vertices, more than eight gain nothing.
constexpr int dead_end_choices = 8;

// What the step after the next is worth beside the next, when two are compared, and what it costs where there is none.
constexpr float next_step_worth = 0.5f;
constexpr float dead_end_cost = 2.0f;

// A face as one of its vertices sees it: the other two, in order.
struct Wing {
    std::uint32_t next, last;
};

class Reordering {
public:
    Reordering(std::span<const std::uint32_t> indices, std::uint32_t vertices, int cache, const LinYuWeights& weights)
        : size_(static_cast<std::uint32_t>(cache)), weights_(weights), first_(vertices + 1), wings_(indices.size()), left_(vertices),
          pushed_(vertices, 0), clock_(size_ + 1), cache_{std::vector(size_, none), std::vector(size_, Needs{}), std::vector<std::uint8_t>(size_, 1)},
          open_before_(size_ + 1) {
        for (const std::uint32_t v : indices) ++left_[v];
        for (std::uint32_t v = 0; v < vertices; ++v) first_[v + 1] = first_[v] + left_[v];
        std::vector<std::uint32_t> place(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            wings_[place[a]++] = {b, c};
            wings_[place[b]++] = {c, a};
            wings_[place[c]++] = {a, b};
        }
        order_.reserve(indices.size());
        touched_.reserve(indices.size());
    }

    std::vector<std::uint32_t> run() {
        while (order_.size() < wings_.size()) {
            const Choice choice = cheapest();
            std::uint32_t v = choice.best;
            if (v == none) {
                v = restart();
            } else if (choice.second != none &&
                       choice.second_cost + next_step_worth * cost_after(choice.second) < choice.best_cost + next_step_worth * cost_after(choice.best)) {
                v = choice.second;
            }
            draw_fan(v);
        }
        return std::move(order_);
    }

private:
    // What the cost of a vertex depends on and what only changes when a neighbour enters or leaves the cache.
    struct Needs {
        std::uint32_t pushes = 0;  // neighbours to be pushed
        std::uint32_t opened = 0;  // faces left at those, beyond the ones drawn with this vertex
    };

    struct Cache {
        std::vector<std::uint32_t> ring;  // the vertex pushed at each clock, modulo the cache's size
        std::vector<Needs> known;         // per slot, unless stale
        std::vector<std::uint8_t> stale;
    };
    struct Choice {
        std::uint32_t best = none, second = none;  // the second only where it is nearly as good
        float best_cost = std::numeric_limits<float>::max(), second_cost = std::numeric_limits<float>::max();
    };

    bool cached(std::uint32_t v) const { return clock_ - pushed_[v] <= size_; }
    std::span<Wing> wings(std::uint32_t v) { return {&wings_[first_[v]], left_[v]}; }  // of the faces left

    Needs needs(std::uint32_t v) {
        std::array<std::uint32_t, 32> seen;  // a vertex of higher valence counts its later neighbours twice: it is costly either way
        Needs n;
        std::uint32_t corners = 0;
        for (const Wing& w : wings(v))
            for (const std::uint32_t x : {w.next, w.last}) {
                if (cached(x)) continue;
                ++corners;
                if (std::find(seen.begin(), seen.begin() + std::min(n.pushes, 32u), x) != seen.begin() + std::min(n.pushes, 32u)) continue;
                if (n.pushes < 32) seen[n.pushes] = x;
                ++n.pushes;
                n.opened += left_[x];
            }
        n.opened -= std::min(n.opened, corners);
        return n;
    }

    Choice cheapest() {
        // open_before_[i]: how many of the i vertices next to leave the cache have faces left.
        std::uint32_t slot = clock_ % size_;
        for (std::uint32_t i = 0; i < size_; ++i) {
            const std::uint32_t v = cache_.ring[slot];
            open_before_[i + 1] = open_before_[i] + (v != none && left_[v] > 0 ? 1 : 0);
            slot = slot + 1 == size_ ? 0 : slot + 1;
        }
        Choice choice;
        if (open_before_[size_] == 0) return choice;
        const float per_age = weights_.freshness / static_cast<float>(size_);
        for (std::uint32_t i = 0; i < size_; ++i) {
            if (open_before_[i + 1] == open_before_[i]) continue;
            slot = (clock_ + i) % size_;
            const std::uint32_t v = cache_.ring[slot];
            if (cache_.stale[slot]) {
                cache_.known[slot] = needs(v);
                cache_.stale[slot] = 0;
            }
            const Needs n = cache_.known[slot];
            const std::uint32_t age = clock_ + n.pushes - pushed_[v];
            const bool leaves = age > size_;
            float cost = static_cast<float>(n.pushes) + weights_.faces * static_cast<float>(left_[v]) +
                         weights_.evicted * static_cast<float>(open_before_[std::min(n.pushes, size_)]) + weights_.opened * static_cast<float>(n.opened);
            // A vertex that its own fan drives out must be pushed once more, and is as fresh as can be; it is not one left open.
            cost += leaves ? 2.0f - weights_.evicted : weights_.freshness - per_age * static_cast<float>(age);
            if (cost < choice.best_cost) {
                choice.second = choice.best;
                choice.second_cost = choice.best_cost;
                choice.best = v;
                choice.best_cost = cost;
            } else if (cost < choice.second_cost) {
                choice.second = v;
                choice.second_cost = cost;
            }
        }
        if (!(choice.second_cost - choice.best_cost < weights_.undecided)) choice.second = none;
        return choice;
    }

    // The least cost of the step after v's, found by drawing v and taking it back.
    float cost_after(std::uint32_t v) {
        saved_ = cache_;
        const std::uint32_t clock = clock_;
        const std::size_t drawn = order_.size(), touched = touched_.size();
        trying_ = true;
        draw_fan(v);
        const Choice next = cheapest();
        trying_ = false;
        // Faces taken away last lie right behind those left.
        for (std::size_t i = drawn; i < order_.size(); ++i) ++left_[order_[i]];
        order_.resize(drawn);
        touched_.resize(touched);
        while (!pushes_.empty()) {
            pushed_[pushes_.back().vertex] = pushes_.back().before;
            pushes_.pop_back();
        }
        clock_ = clock;
        cache_ = saved_;
        return next.best == none ? dead_end_cost : next.best_cost;
    }

    // No cached vertex has faces left: go on near by, or anywhere.
    std::uint32_t restart() {
        std::uint32_t best = none;
        float least = std::numeric_limits<float>::max();
        int choices = 0;
        for (std::size_t i = touched_.size(); i-- > 0 && choices < dead_end_choices;) {
            const std::uint32_t v = touched_[i];
            if (left_[v] == 0) {
                if (i + 1 == touched_.size()) touched_.pop_back();
                continue;
            }
            ++choices;
            const float cost = static_cast<float>(needs(v).pushes) + weights_.faces * static_cast<float>(left_[v]);
            if (cost < least) {
                least = cost;
                best = v;
            }
        }
        if (best != none) return best;
        while (left_[untouched_] == 0) ++untouched_;
        return untouched_;
    }

    void mark_stale_around(std::uint32_t v) {
        for (const Wing& w : wings(v))
            for (const std::uint32_t x : {w.next, w.last})
                if (cached(x)) cache_.stale[pushed_[x] % size_] = 1;
    }

    void push(std::uint32_t v) {
        const std::uint32_t slot = clock_ % size_;
        const std::uint32_t leaving = cache_.ring[slot];
        if (trying_) pushes_.push_back({v, pushed_[v]});
        pushed_[v] = clock_++;
        cache_.ring[slot] = v;
        cache_.stale[slot] = 1;
        if (leaving != none && left_[leaving] > 0 && !cached(leaving)) mark_stale_around(leaving);
        mark_stale_around(v);
    }

    // Takes the face (next, last) away from v's list of faces left.
    void take(std::uint32_t v, std::uint32_t next, std::uint32_t last) {
        const std::span<Wing> all = wings(v);
        std::size_t i = 0;
        while (all[i].next != next || all[i].last != last) ++i;
        std::swap(all[i], all.back());
        --left_[v];
    }

    // All faces left of v, those first that need fewest pushes and, among them, those whose other cached vertex is oldest: the next
    // row then enters the cache in the order in which this row entered, and leaves it in the order in which it is done with.
    void draw_fan(std::uint32_t v) {
        if (!cached(v)) push(v);
        while (left_[v] > 0) {
            const std::span<const Wing> all = wings(v);
            std::size_t best = 0;
            std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
            for (std::size_t i = 0; i < all.size(); ++i) {
                const std::uint32_t p = pushed_[all[i].next], q = pushed_[all[i].last];
                const bool in_p = clock_ - p <= size_, in_q = clock_ - q <= size_;
                const std::uint32_t oldest = std::min(in_p ? p : none, in_q ? q : none);
                const std::uint64_t key = static_cast<std::uint64_t>(!in_p + !in_q) << 32 | oldest;
                if (key < least) {
                    least = key;
                    best = i;
                }
            }
            const Wing w = all[best];
            for (const std::uint32_t x : {v, w.next, w.last})
                if (!cached(x)) push(x);
            order_.insert(order_.end(), {v, w.next, w.last});
            touched_.insert(touched_.end(), {w.next, w.last});
            take(v, w.next, w.last);
            take(w.next, w.last, v);
            take(w.last, v, w.next);
        }
    }

    const std::uint32_t size_;
    const LinYuWeights weights_;
    std::vector<std::uint32_t> first_;
    std::vector<Wing> wings_;
    std::vector<std::uint32_t> left_;    // faces left per vertex
    std::vector<std::uint32_t> pushed_;  // the clock when the vertex was last pushed; it is cached for `size_` pushes
    std::uint32_t clock_;                // pushes so far; begins where no vertex is cached
    Cache cache_, saved_;
    std::vector<std::uint32_t> open_before_;
    std::vector<std::uint32_t> touched_;  // a stack of vertices of faces drawn
    std::uint32_t untouched_ = 0;
    std::vector<std::uint32_t> order_;

    struct Push {
        std::uint32_t vertex, before;
    };
    bool trying_ = false;
    std::vector<Push> pushes_;  // made while trying
};

}  // namespace

LinYuWeights lin_yu_weights(int cache) {
    if (cache < 24) return {};
    return {.faces = -0.913f, .freshness = 1.728f, .evicted = 0.88f, .opened = 0.168f, .undecided = 0.15f};
}

std::vector<std::uint32_t> lin_yu_order(std::span<const std::uint32_t> indices, std::uint32_t vertices, int cache, const LinYuWeights& weights) {
    assert(cache >= 4 && cache <= 255 && indices.size() % 3 == 0);
    if (indices.empty()) return {};
    return Reordering(indices, vertices, cache, weights).run();
}

}  // namespace relievo

#include "mesh/lin_yu.h"

#include <algorithm>
#include <array>
#include <bit>
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
        : size_(static_cast<std::uint32_t>(cache)), mask_(std::bit_ceil(size_) - 1), weights_(weights), vertices_(vertices), wings_(indices.size()),
          clock_(size_ + 1), cache_(mask_ + 1), order_(indices.size()) {
        for (const std::uint32_t v : indices) ++vertices_[v].left;
        std::uint32_t first = 0;
        for (Vertex& v : vertices_) {
            v.first = first;
            first += v.left;
            v.left = 0;
        }
        const auto add = [&](std::uint32_t v, std::uint32_t next, std::uint32_t last) { wings_[vertices_[v].first + vertices_[v].left++] = {next, last}; };
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
            add(a, b, c);
            add(b, c, a);
            add(c, a, b);
        }
    }

    std::vector<std::uint32_t> run() {
        while (drawn_ < order_.size()) {
            const Choice choice = cheapest();
            std::uint32_t v = choice.best;
            if (v == none) {
                v = restart();
            } else if (choice.second != none &&
                       choice.second_cost + next_step_worth * cost_after(choice.second) < choice.best_cost + next_step_worth * cost_after(choice.best)) {
                v = choice.second;
            }
            draw_fan<false>(v);
        }
        return std::move(order_);
    }

private:
    // Together, because where one is read the others are.
    struct Vertex {
        std::uint32_t first = 0;   // of its wings
        std::uint32_t left = 0;    // faces not drawn yet: their wings stand first
        std::uint32_t pushed = 0;  // the clock when it was last pushed; it is cached for `size_` pushes
    };
    // A place of the cache: the vertex, and what its cost depends on that only changes when a neighbour enters or leaves.
    struct Slot {
        std::uint32_t vertex = none;
        std::uint32_t pushes = 0;  // neighbours to be pushed for its faces
        std::uint32_t opened = 0;  // faces left at those, beyond the ones drawn with this vertex
        std::uint32_t stale = 1;   // pushes and opened are not known
    };
    struct Choice {
        std::uint32_t best = none, second = none;  // the second only where it is nearly as good
        float best_cost = std::numeric_limits<float>::max(), second_cost = std::numeric_limits<float>::max();
    };

    bool fresh(std::uint32_t pushed) const { return clock_ - pushed <= size_; }
    bool cached(std::uint32_t v) const { return fresh(vertices_[v].pushed); }
    std::span<Wing> wings(const Vertex& v) { return {&wings_[v.first], v.left}; }

    void look_around(Slot& slot) {
        std::array<std::uint32_t, 32> seen;  // a vertex of higher valence counts its later neighbours twice: it is costly either way
        std::uint32_t pushes = 0, opened = 0, corners = 0;
        for (const Wing& w : wings(vertices_[slot.vertex]))
            for (const std::uint32_t x : {w.next, w.last}) {
                if (cached(x)) continue;
                ++corners;
                const auto end = seen.begin() + std::min(pushes, 32u);
                if (std::find(seen.begin(), end, x) != end) continue;
                if (pushes < 32) seen[pushes] = x;
                ++pushes;
                opened += vertices_[x].left;
            }
        slot = {slot.vertex, pushes, opened - std::min(opened, corners), 0};
    }

    Choice cheapest() {
        Choice choice;
        // How many of the vertices next to leave the cache have faces left: up_to[i] of the first i.
        std::array<std::uint8_t, 256> up_to;
        std::array<std::uint32_t, 255> open;  // places of those that have
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < size_; ++i) {
            up_to[i] = static_cast<std::uint8_t>(count);
            const std::uint32_t v = cache_[(clock_ - size_ + i) & mask_].vertex;
            open[count] = i;
            count += v != none && vertices_[v].left > 0;
        }
        up_to[size_] = static_cast<std::uint8_t>(count);
        const float per_age = weights_.freshness / static_cast<float>(size_);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t i = open[k];
            Slot& slot = cache_[(clock_ - size_ + i) & mask_];
            if (slot.stale) look_around(slot);
            const std::uint32_t age = size_ - i + slot.pushes;
            float cost = static_cast<float>(slot.pushes) + weights_.faces * static_cast<float>(vertices_[slot.vertex].left) +
                         weights_.evicted * static_cast<float>(up_to[std::min(slot.pushes, size_)]) + weights_.opened * static_cast<float>(slot.opened);
            // A vertex that its own fan drives out must be pushed once more, and is as fresh as can be; it is not one left open.
            cost += age > size_ ? 2.0f - weights_.evicted : weights_.freshness - per_age * static_cast<float>(age);
            if (cost < choice.best_cost) {
                choice.second = choice.best;
                choice.second_cost = choice.best_cost;
                choice.best = slot.vertex;
                choice.best_cost = cost;
            } else if (cost < choice.second_cost) {
                choice.second = slot.vertex;
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
        const std::size_t drawn = drawn_;
        draw_fan<true>(v);
        const Choice next = cheapest();
        // Faces taken away last lie right behind those left.
        for (std::size_t i = drawn; i < drawn_; ++i) ++vertices_[order_[i]].left;
        drawn_ = drawn;
        for (; !pushes_.empty(); pushes_.pop_back()) vertices_[pushes_.back().vertex].pushed = pushes_.back().before;
        clock_ = clock;
        cache_.swap(saved_);
        return next.best == none ? dead_end_cost : next.best_cost;
    }

    // No cached vertex has faces left: go on near what was drawn last, or anywhere.
    std::uint32_t restart() {
        std::uint32_t best = none;
        float least = std::numeric_limits<float>::max();
        int choices = 0;
        for (std::size_t i = touched_.size(); i-- > 0 && choices < dead_end_choices;) {
            const std::uint32_t v = touched_[i];
            if (vertices_[v].left == 0) {
                if (i + 1 == touched_.size()) touched_.pop_back();
                continue;
            }
            ++choices;
            Slot slot{.vertex = v};
            look_around(slot);
            const float cost = static_cast<float>(slot.pushes) + weights_.faces * static_cast<float>(vertices_[v].left);
            if (cost < least) {
                least = cost;
                best = v;
            }
        }
        if (best != none) return best;
        while (vertices_[untouched_].left == 0) ++untouched_;
        return untouched_;
    }

    void mark_stale_around(const Vertex& v) {
        for (const Wing& w : wings(v))
            for (const std::uint32_t x : {w.next, w.last})
                if (const std::uint32_t pushed = vertices_[x].pushed; fresh(pushed)) cache_[pushed & mask_].stale = 1;
    }

    template <bool trying>
    void push(std::uint32_t v) {
        Vertex& vertex = vertices_[v];
        if constexpr (trying) pushes_.push_back({v, vertex.pushed});
        vertex.pushed = clock_++;
        // The vertex that leaves now was pushed `size_` + 1 pushes ago; its neighbours will need it anew.
        const std::uint32_t leaving = cache_[(clock_ - size_ - 1) & mask_].vertex;
        cache_[vertex.pushed & mask_] = {.vertex = v};
        if (leaving != none && vertices_[leaving].left > 0 && !cached(leaving)) mark_stale_around(vertices_[leaving]);
        mark_stale_around(vertex);
    }

    // Takes the face (next, last) away from v's list of faces left, to right behind it.
    void take(std::uint32_t v, std::uint32_t next, std::uint32_t last) {
        Vertex& vertex = vertices_[v];
        Wing* const all = &wings_[vertex.first];
        std::uint32_t i = 0;
        while (all[i].next != next || all[i].last != last) ++i;
        std::swap(all[i], all[--vertex.left]);
    }

    // All faces left of v, those first that need fewest pushes and, among them, those whose other cached vertex is oldest: the next
    // row then enters the cache in the order in which this row entered, and leaves it in the order in which it is done with.
    template <bool trying>
    void draw_fan(std::uint32_t v) {
        [[maybe_unused]] const std::size_t begun = drawn_;
        if (!cached(v)) push<trying>(v);
        while (vertices_[v].left > 0) {
            Wing best{};
            std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
            for (const Wing& w : wings(vertices_[v])) {
                const std::uint32_t p = vertices_[w.next].pushed, q = vertices_[w.last].pushed;
                const bool in_p = fresh(p), in_q = fresh(q);
                const std::uint32_t oldest = std::min(in_p ? p : none, in_q ? q : none);
                const std::uint64_t key = static_cast<std::uint64_t>(!in_p + !in_q) << 32 | oldest;
                if (key < least) {
                    least = key;
                    best = w;
                }
            }
            for (const std::uint32_t x : {v, best.next, best.last}) {
                if (!cached(x)) push<trying>(x);
                order_[drawn_++] = x;
            }
            take(v, best.next, best.last);
            take(best.next, best.last, v);
            take(best.last, v, best.next);
        }
        if constexpr (!trying)
            for (std::size_t i = begun; i < drawn_; ++i)
                if (vertices_[order_[i]].left > 0) touched_.push_back(order_[i]);
    }

    const std::uint32_t size_, mask_;
    const LinYuWeights weights_;
    std::vector<Vertex> vertices_;
    std::vector<Wing> wings_;
    std::uint32_t clock_;              // pushes so far; begins where no vertex is cached
    std::vector<Slot> cache_, saved_;  // the vertex pushed at each clock, modulo a power of two that is at least `size_`
    std::uint32_t untouched_ = 0;
    std::vector<std::uint32_t> order_;
    std::size_t drawn_ = 0;               // of order_
    std::vector<std::uint32_t> touched_;  // a stack of vertices of faces drawn that had faces left then

    struct Push {
        std::uint32_t vertex, before;
    };
    std::vector<Push> pushes_;  // made while trying
};

}  // namespace

LinYuWeights lin_yu_weights(int cache) {
    if (cache < 24) return {};
    return {.faces = -0.913f, .freshness = 1.728f, .evicted = 0.5f, .opened = 0.168f, .undecided = 0.15f};
}

std::vector<std::uint32_t> lin_yu_order(std::span<const std::uint32_t> indices, std::uint32_t vertices, int cache, const LinYuWeights& weights) {
    assert(cache >= 4 && cache <= 255 && indices.size() % 3 == 0);
    if (indices.empty()) return {};
    return Reordering(indices, vertices, cache, weights).run();
}

}  // namespace relievo

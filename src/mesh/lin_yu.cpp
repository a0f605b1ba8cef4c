#include "mesh/lin_yu.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <span>
#include <utility>

namespace relievo {

namespace {

constexpr std::uint32_t none = 0xffffffff;
constexpr std::uint32_t not_known = 0xffffffff;

// At a dead end this many vertices are looked at, those that left the cache last first: they are likely to lie beside what is cached in
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
    Reordering(std::vector<std::uint32_t> indices, std::uint32_t vertices, int cache, const LinYuWeights& weights)
        : size_(static_cast<std::uint32_t>(cache)), mask_(std::bit_ceil(size_) - 1), weights_(weights), vertices_(vertices), wings_(indices.size()),
          per_age_(weights.freshness / static_cast<float>(size_)), clock_(size_ + 1), cache_(mask_ + 1), saved_(mask_ + 1) {
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
        order_ = std::move(indices);
    }

    std::vector<std::uint32_t> run() {
        Choice choice;
        while (drawn_ < order_.size()) {
            std::uint32_t v = choice.best == none ? restart() : choice.best;
            if (choice.second != none) {
                // The best is tried last: if it stays the best, what was tried is done.
                const Trial second = tried(choice.second);
                take_back(second);
                const Trial best = tried(choice.best);
                if (choice.best_cost + next_step_worth * best.cost() <= choice.second_cost + next_step_worth * second.cost()) {
                    pushes_.clear();
                    choice = best.next;
                    continue;
                }
                take_back(best);
                v = choice.second;
            }
            draw_fan<false>(v);
            choice = cheapest();
        }
        return std::move(order_);
    }

private:
    // Together, because where one is read the others are.
    struct alignas(16) Vertex {
        std::uint32_t first = 0;   // of its wings
        std::uint32_t left = 0;    // faces not drawn yet: their wings stand first
        std::uint32_t pushed = 0;  // the clock when it was last pushed; it is cached for `size_` pushes
    };
    // A place of the cache: the vertex, its faces left, and what its cost depends on, brought up to date when a neighbour enters or leaves.
    struct Slot {
        std::uint32_t vertex = none;
        std::uint32_t left = 0;
        std::uint32_t pushes = not_known;  // neighbours to be pushed for its faces
        std::uint32_t their_faces = 0;     // left at those
        std::uint32_t corners = 0;         // of its faces that are to be pushed
        std::uint32_t change = 0;          // the last one that this place took part in
    };
    struct Choice {
        std::uint32_t best = none, second = none;  // the second only where it is nearly as good
        float best_cost = std::numeric_limits<float>::max(), second_cost = std::numeric_limits<float>::max();
    };
    // What was before a fan was drawn, and what comes after it.
    struct Trial {
        std::uint32_t clock = 0;
        std::size_t drawn = 0, left_behind = 0;
        Choice next;
        float cost() const { return next.best == none ? dead_end_cost : next.best_cost; }
    };

    bool fresh(std::uint32_t pushed) const { return clock_ - pushed <= size_; }
    bool cached(std::uint32_t v) const { return fresh(vertices_[v].pushed); }
    std::span<Wing> wings(const Vertex& v) { return {&wings_[v.first], v.left}; }

    void look_around(Slot& slot) {
        std::array<std::uint32_t, 32> seen;  // a vertex of higher valence counts its later neighbours twice: it is costly either way
        std::uint32_t pushes = 0, their_faces = 0, corners = 0;
        for (const Wing& w : wings(vertices_[slot.vertex]))
            for (const std::uint32_t x : {w.next, w.last}) {
                if (cached(x)) continue;
                ++corners;
                const auto end = seen.begin() + std::min(pushes, 32u);
                if (std::find(seen.begin(), end, x) != end) continue;
                if (pushes < 32) seen[pushes] = x;
                ++pushes;
                their_faces += vertices_[x].left;
            }
        slot.pushes = pushes;
        slot.their_faces = their_faces;
        slot.corners = corners;
    }

    Choice cheapest() {
        Choice choice;
        // How many of the vertices next to leave the cache have faces left: up_to[i] of the first i.
        std::array<std::uint8_t, 256> up_to;
        std::array<std::uint8_t, 255> open;  // places of those that have
        std::uint32_t count = 0;
        const std::uint32_t oldest = clock_ - size_;
        for (std::uint32_t i = 0; i < size_; ++i) {
            up_to[i] = static_cast<std::uint8_t>(count);
            open[count] = static_cast<std::uint8_t>(i);
            count += cache_[(oldest + i) & mask_].left > 0;
        }
        up_to[size_] = static_cast<std::uint8_t>(count);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t i = open[k];
            Slot& slot = cache_[(oldest + i) & mask_];
            if (slot.pushes == not_known) look_around(slot);
            const std::uint32_t age = size_ - i + slot.pushes;
            const std::uint32_t opened = slot.their_faces - std::min(slot.their_faces, slot.corners);
            float cost = static_cast<float>(slot.pushes) + weights_.faces * static_cast<float>(slot.left) + weights_.opened * static_cast<float>(opened) +
                         weights_.evicted * static_cast<float>(up_to[std::min(slot.pushes, size_)]);
            // A vertex that its own fan drives out must be pushed once more, and is as fresh as can be; it is not one left open.
            cost += age > size_ ? 2.0f - weights_.evicted : weights_.freshness - per_age_ * static_cast<float>(age);
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

    // Draws v's fan in a way that can be taken back.
    Trial tried(std::uint32_t v) {
        Trial trial{clock_, drawn_, left_behind_.size(), {}};
        std::copy(cache_.begin(), cache_.end(), saved_.begin());
        draw_fan<true>(v);
        trial.next = cheapest();
        return trial;
    }

    void take_back(const Trial& trial) {
        // Faces taken away last lie right behind those left.
        for (std::size_t i = trial.drawn; i < drawn_; ++i) ++vertices_[order_[i]].left;
        drawn_ = trial.drawn;
        left_behind_.resize(trial.left_behind);
        for (; !pushes_.empty(); pushes_.pop_back()) vertices_[pushes_.back().vertex].pushed = pushes_.back().before;
        clock_ = trial.clock;
        cache_.swap(saved_);
    }

    // No cached vertex has faces left: go on near what was drawn last, or anywhere.
    std::uint32_t restart() {
        std::uint32_t best = none;
        float least = std::numeric_limits<float>::max();
        int choices = 0;
        for (std::size_t i = left_behind_.size(); i-- > 0 && choices < dead_end_choices;) {
            const std::uint32_t v = left_behind_[i];
            if (vertices_[v].left == 0) {
                if (i + 1 == left_behind_.size()) left_behind_.pop_back();
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

    // Tells the cached neighbours of v, which is not cached, that it is about to enter or has just left.
    template <bool enters>
    void tell_neighbours(const Vertex& v) {
        ++change_;
        for (const Wing& w : wings(v))
            for (const std::uint32_t x : {w.next, w.last}) {
                const std::uint32_t pushed = vertices_[x].pushed;
                if (!fresh(pushed)) continue;
                Slot& slot = cache_[pushed & mask_];
                if (slot.pushes == not_known) continue;
                const std::uint32_t first = slot.change != change_, faces = first * v.left;
                slot.change = change_;
                slot.corners += enters ? none : 1;  // modulo 2^32
                slot.pushes += enters ? 0 - first : first;
                slot.their_faces += enters ? 0 - faces : faces;
            }
    }

    // A face of v is drawn although v has left: what its neighbours know of it is wrong by that face.
    void forget_around(const Vertex& v) {
        for (const Wing& w : wings(v))
            for (const std::uint32_t x : {w.next, w.last})
                if (const std::uint32_t pushed = vertices_[x].pushed; fresh(pushed)) cache_[pushed & mask_].pushes = not_known;
    }

    template <bool trying>
    void push(std::uint32_t v) {
        Vertex& vertex = vertices_[v];
        if constexpr (trying) pushes_.push_back({v, vertex.pushed});
        tell_neighbours<true>(vertex);
        vertex.pushed = clock_++;
        // The vertex that leaves now was pushed `size_` + 1 pushes ago; its neighbours will need it anew.
        const Slot leaving = cache_[(clock_ - size_ - 1) & mask_];
        cache_[vertex.pushed & mask_] = {.vertex = v, .left = vertex.left};
        if (leaving.left == 0 || cached(leaving.vertex)) return;
        tell_neighbours<false>(vertices_[leaving.vertex]);
        left_behind_.push_back(leaving.vertex);
    }

    // Takes the face (next, last) away from v's list of faces left, to right behind it. It is not before place `i` of that list.
    void take(std::uint32_t v, std::uint32_t next, std::uint32_t last, std::uint32_t i = 0) {
        Vertex& vertex = vertices_[v];
        const bool in_cache = fresh(vertex.pushed);
        if (!in_cache) forget_around(vertex);
        Wing* const all = &wings_[vertex.first];
        while (all[i].next != next || all[i].last != last) ++i;
        std::swap(all[i], all[--vertex.left]);
        if (in_cache) cache_[vertex.pushed & mask_].left = vertex.left;
    }

    // All faces left of v, those first that need fewest pushes and, among them, those whose other cached vertex is oldest: the next
    // row then enters the cache in the order in which this row entered, and leaves it in the order in which it is done with.
    template <bool trying>
    void draw_fan(std::uint32_t v) {
        if (!cached(v)) push<trying>(v);
        while (vertices_[v].left > 0) {
            const std::span<const Wing> left = wings(vertices_[v]);
            std::uint32_t best_place = 0;
            std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
            for (std::uint32_t i = 0; i < left.size(); ++i) {
                const Wing& w = left[i];
                const std::uint32_t p = vertices_[w.next].pushed, q = vertices_[w.last].pushed;
                const bool in_p = fresh(p), in_q = fresh(q);
                const std::uint32_t oldest = std::min(in_p ? p : none, in_q ? q : none);
                const std::uint64_t key = static_cast<std::uint64_t>(!in_p + !in_q) << 32 | oldest;
                if (key < least) {
                    least = key;
                    best_place = i;
                }
            }
            const Wing best = left[best_place];
            for (const std::uint32_t x : {v, best.next, best.last}) {
                if (!cached(x)) push<trying>(x);
                order_[drawn_++] = x;
            }
            take(v, best.next, best.last, best_place);
            take(best.next, best.last, v);
            take(best.last, v, best.next);
        }
    }

    const std::uint32_t size_, mask_;
    const LinYuWeights weights_;
    std::vector<Vertex> vertices_;
    std::vector<Wing> wings_;
    const float per_age_;
    std::uint32_t clock_;              // pushes so far; begins where no vertex is cached
    std::vector<Slot> cache_, saved_;  // the vertex pushed at each clock, modulo a power of two that is at least `size_`
    std::uint32_t change_ = 0;         // how often neighbours were told
    std::uint32_t untouched_ = 0;
    std::vector<std::uint32_t> order_;
    std::size_t drawn_ = 0;                   // of order_
    std::vector<std::uint32_t> left_behind_;  // a stack of vertices that left the cache with faces left

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

std::vector<std::uint32_t> lin_yu_order(std::vector<std::uint32_t> indices, std::uint32_t vertices, int cache, const LinYuWeights& weights) {
    assert(cache >= 4 && cache <= 255 && indices.size() % 3 == 0);
    if (indices.empty()) return {};
    return Reordering(std::move(indices), vertices, cache, weights).run();
}

}  // namespace relievo

#include "pipeline/fur_steadiness.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

FurChange change_between(const FurFrames& a, const FurFrames& reference_a, const FurFrames& b, const FurFrames& reference_b, const FurFrames* b_as_layered_before) {
    FurChange sum;
    std::size_t covered = 0;
    const auto difference = [](const FurFrames& from, const FurFrames& to, std::size_t c) { return static_cast<double>(to.colour.texels[c]) - static_cast<double>(from.colour.texels[c]); };
    for (std::size_t p = 0; p < a.coverage.texels.size(); ++p) {
        if (!(a.coverage.texels[p] > 0 || b.coverage.texels[p] > 0 || reference_a.coverage.texels[p] > 0 || reference_b.coverage.texels[p] > 0)) continue;
        ++covered;
        for (std::size_t c = p * 3; c < p * 3 + 3; ++c) {
            const double picture = difference(a, b, c), reference = difference(reference_a, reference_b, c);
            sum.picture += std::abs(picture);
            sum.reference += std::abs(reference);
            sum.error += std::abs(picture - reference);
            if (b_as_layered_before) sum.layers += std::abs(difference(*b_as_layered_before, b, c));
        }
    }
    const double weight = covered > 0 ? 1 / (3 * static_cast<double>(covered)) : 0;
    return {sum.picture * weight, sum.reference * weight, sum.error * weight, sum.layers * weight};
}

}  // namespace

void SteadinessMeter::add(FilmedFrame frame) {
    assert(frame.pictures.size() == passes_.size() && (frame.as_layered_before.empty() || frame.as_layered_before.size() == passes_.size()));
    if (before_) {
        for (std::size_t i = 0; i < passes_.size(); ++i)
            changes_[i].push_back(change_between(before_->pictures[i], before_->reference, frame.pictures[i], frame.reference, frame.as_layered_before.empty() ? nullptr : &frame.as_layered_before[i]));
        steps_.push_back({.distance = frame.distance, .layers = frame.layers, .change = changes_.back().back()});
    }
    before_ = std::move(frame);
}

std::optional<FurSteadiness> SteadinessMeter::result() const {
    if (steps_.empty()) return std::nullopt;
    FurSteadiness result{.samples = samples_, .rows = {}, .steps = steps_};
    for (std::size_t i = 0; i < passes_.size(); ++i) {
        FurSteadiness::Row& row = result.rows.emplace_back();
        row.passes = passes_[i];
        std::vector<double> errors;
        std::size_t relayered = 0;
        const double share = 1 / static_cast<double>(changes_[i].size());
        for (const FurChange& c : changes_[i]) {
            row.mean.picture += share * c.picture;
            row.mean.reference += share * c.reference;
            row.mean.error += share * c.error;
            row.mean.layers += c.layers;
            relayered += c.layers > 0;
            if (c.picture > 0) row.pop = std::max(row.pop, c.layers / c.picture);
            errors.push_back(c.error);
        }
        if (relayered > 0) row.mean.layers /= static_cast<double>(relayered);
        std::ranges::sort(errors);
        const double median = errors[errors.size() / 2];
        row.worst_over_median = median > 0 ? errors.back() / median : 1;
    }
    return result;
}

}  // namespace relievo

// Contract 7: every effect a row claims is measured present, and every one it does not claim absent (effects/effects.h: the scenes,
// the numbers and the thresholds that `relievo effects` prints too).
#include "contract/trace.h"
#include "effects/effects.h"

namespace relievo::contract {
namespace {

class EffectClaims : public EveryTechnique {};

TEST_P(EffectClaims, are_measured) {
    for (const EffectKind& kind : effect_kinds()) {
        const double measured = kind.measure(technique());
        RecordProperty(std::string(kind.id), std::to_string(measured));
        // Nothing lies between "there" and "not there": a technique in the gap needs a better scene or a better claim.
        if (technique().effects.*kind.claim) {
            EXPECT_GE(measured, kind.present_from) << kind.id << ": claimed, and measured absent";
        } else {
            EXPECT_LE(measured, kind.absent_to) << kind.id << ": not claimed, and measured present";
        }
    }
}

TEST_P(EffectClaims, shift_along_the_view_and_no_farther_than_the_surface) {
    const Parallax share = measured_parallax(technique());
    EXPECT_LT(share.sideways, 1e-6) << "the shift is not along the view";
    EXPECT_LE(share.most, technique().effects.motion_parallax ? 1.05 : 0.0);
}

FOR_EVERY_TECHNIQUE(EffectClaims);

}  // namespace
}  // namespace relievo::contract

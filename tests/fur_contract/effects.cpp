// Fur contract 4: every effect a row claims is measured present, and every one it does not claim absent; and in stubble no
// scene finds an effect of length.
#include "fur_contract/worn.h"
#include "pipeline/fur_effects.h"

namespace relievo::fur_contract {
namespace {

class FurEffectClaims : public EveryMode {};

TEST_P(FurEffectClaims, are_measured) {
    for (const FurEffectKind& kind : fur_effect_kinds()) {
        const double measured = kind.measure(*painter, 1);
        RecordProperty(std::string(kind.id), std::to_string(measured));
        if (mode().effects.*kind.claim) {
            EXPECT_GE(measured, kind.present_from) << kind.id << ": claimed, and measured absent";
        } else {
            EXPECT_LE(measured, kind.absent_to) << kind.id << ": not claimed, and measured present";
        }
    }
}

TEST_P(FurEffectClaims, come_from_length) {
    for (const FurEffectKind& kind : fur_effect_kinds()) {
        if (kind.id == "even_roots") continue;
        EXPECT_LE(kind.measure(*painter, fur_stubble), kind.absent_to) << kind.id << " of stubble";
    }
}

FOR_EVERY_MODE(FurEffectClaims);

}  // namespace
}  // namespace relievo::fur_contract

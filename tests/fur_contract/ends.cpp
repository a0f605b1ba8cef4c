#include "fur_contract/worn.h"

namespace relievo::fur_contract {
namespace {

class Ends : public testing::Environment {
    struct Painters : EveryMode {
        static void end() { painters().clear(); }
    };
    void TearDown() override { Painters::end(); }
};
const auto* const ends = testing::AddGlobalTestEnvironment(new Ends);

}  // namespace
}  // namespace relievo::fur_contract

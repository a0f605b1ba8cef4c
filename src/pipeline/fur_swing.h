// Fur that swings while its mesh turns, from frame to frame: what a film and its reference share.
#pragma once

#include "fur/fur_motion.h"

#include <vector>

namespace relievo {

struct SwingSettings {
    FurForces forces;               // told in the space of the camera, in which the mesh turns: `time` and `spin` are not looked at
    double turns_per_second = 0;    // of the mesh around its vertical axis, reached from rest within the first half second
    double frames_per_second = 25;
    int threads = 0;
};

// Begins as gravity alone holds the fur; the wind sets in with the first frame, in gusts. What `skin` names must stay where it is.
class FurSwing {
public:
    FurSwing(const FurSkin& skin, const SwingSettings& settings);

    double angle() const { return angle_; }  // by which the mesh has turned, radians
    std::vector<Vec3f> pushes() const { return pushes_of(motion_); }
    void next_frame();

private:
    FurSkin skin_;
    SwingSettings settings_;
    FurMotion motion_;
    double angle_ = 0, time_ = 0;
};

}  // namespace relievo

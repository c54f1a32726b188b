// Random skeletons with pathological clips, and clusters skinned to them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/cook/animation/posed_models.h"

namespace hearth::test
{

struct CharacterSpec
{
    uint32_t joints = 12;
    uint32_t clips = 3;
    uint32_t keys = 5;
    double swing = 0.5;    ///< maximum angle between a key's rotation and the rest pose, radians
    bool splines = false;  ///< cubic splines with tangents of any size, else steps and linear interpolation
    bool spins = false;    ///< each key is a random rotation, or nearly half a turn from the previous one
    bool opposite = false; ///< quaternions with random signs
    double scale_low = 1;  ///< minimum scale in keys
    double scale_high = 1;
    bool mirrored = false; ///< some joints mirror
    bool matrices = false; ///< some nodes have only a matrix, with shear
    bool several_roots = false;
    uint32_t morph_targets = 0;
    uint32_t influences = 4;
    bool far_influences = false; ///< influences of any joints, else of a joint and its ancestors
};

/// Scene with one skinned mesh, whose node is the last.
struct Character
{
    std::vector<formats::NodeRecord> nodes;
    std::vector<formats::SkinRecord> skins;
    std::vector<formats::JointRecord> joints;
    std::vector<formats::AnimationRecord> animations;
    std::vector<formats::AnimationChannelRecord> channels;
    std::vector<float> keys;
    std::vector<float> morph_weights;
    PosedMesh mesh; ///< without bounds

    formats::AnimationTables tables() const
    {
        return {nodes, skins, joints, animations, channels, keys, morph_weights, {}};
    }
};

Character randomCharacter(const CharacterSpec& spec, uint32_t seed);

} // namespace hearth::test

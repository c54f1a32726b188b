// Skeletons with clips that do what clips should not, and clusters that hang on them.
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
    double swing = 0.5;    ///< radians: how far a key's rotation is from the rest pose
    bool splines = false;  ///< cubic splines with tangents of any size, else steps and straight lines
    bool spins = false;    ///< each key a random rotation, or nearly half a turn from the last
    bool opposite = false; ///< quaternions with random signs
    double scale_low = 1;  ///< of scales in keys
    double scale_high = 1;
    bool mirrored = false; ///< some joints turn their inside out
    bool matrices = false; ///< some nodes have a matrix alone, with shear
    bool several_roots = false;
    uint32_t morph_targets = 0;
    uint32_t influences = 4;
    bool far_influences = false; ///< on any joints, else on a joint and its ancestors
};

/// A scene with one skinned mesh, whose node is the last.
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

// Makes a half-open room under three lamps, with a prop that a game moves and a character, for tests of
// baked light.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::test
{

/// Names of nodes.
inline constexpr const char* kPropName = "prop";
inline constexpr const char* kHipName = "hip"; ///< root of the character's joints

inline constexpr Float3 kPropCenter{1.0f, 0.25f, 0.9f}; ///< where it is cooked; it stands on the floor
inline constexpr Float3 kPropHalf{0.25f, 0.25f, 0.25f};

/// Make a room of 4 x 2.6 x 4 m, centre of the floor at the origin, open on the side of +Z. Lights, in this
/// order: "warm" and "cold" are points, "red" is a spot. The character is a tube of two joints, which the
/// only clip bends within a second.
samples::Document makeLampRoom();

} // namespace hearth::test

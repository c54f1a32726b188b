// Character of 60 joints in six limbs, of any number of vertices, whose clips bend all joints back and forth.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/cook/animation/random_characters.h"

namespace hearth::test
{

struct LimbCharacterSize
{
    uint32_t vertices;
    uint32_t influences; ///< 4 or 8
    uint32_t clips;      ///< each bends the joints at another speed
};

/// Make the character, without bounds. Each vertex is moved by a joint, its neighbours in the limb, the root
/// and, with 8 influences, farther joints of the limb.
Character limbCharacter(const LimbCharacterSize& size);

} // namespace hearth::test

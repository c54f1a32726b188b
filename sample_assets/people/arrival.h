// Generates the clip of a character that walks to a seat, turns and sits down.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/people/character.h"

namespace hearth::samples
{

/// Way of a character, on the ground.
struct Arrival
{
    Float3 start;     ///< of the walk
    Float3 stop;      ///< in front of the seat
    Float3 seat;      ///< below the middle of the seat: where the character's root is in the end
    Float3 direction; ///< unit, in which it looks while it sits
};

/// Add the clip "arrive", five seconds: it walks for two, turns, sits down, and warms its hands.
void addArriveClip(Document& document, const CharacterNodes& nodes, const Arrival& arrival);

} // namespace hearth::samples

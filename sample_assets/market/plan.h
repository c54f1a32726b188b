// Lays out the market: where stalls, poles, strings of lamps, trees and houses stand.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/shapes/document.h"

namespace hearth::samples::market
{

/// Half of the paved ground, metres: the street runs along Z, houses close it on all sides.
inline constexpr float kHalfWidth = 25, kHalfLength = 43;
/// Height of the ends of the strings between poles, and how far their middle hangs below, metres.
inline constexpr float kStringHeight = 4.35f, kStringSag = 0.55f;

enum class Roof : uint32_t
{
    awning, ///< one slope, lower at the front
    tent,   ///< a ridge along the stall
};
inline constexpr uint32_t kRoofCount = 2;

/// Number of kinds of goods, of cloths, and of the colours of paper lanterns.
inline constexpr uint32_t kGoodsCount = 6, kClothCount = 6, kPaperCount = 6;

/// Stall in its own frame: 3.2 m wide along X, 2.2 m deep, its front is +Z, the counter's top is at
/// kCounterTop.
struct Stall
{
    Placement placement;
    Roof roof = Roof::awning;
    uint32_t goods = 0;
    uint32_t cloth = 0;
    bool has_spots = true; ///< false: its lights are points alone, where camera "thirty" looks
};
inline constexpr float kCounterTop = 0.93f;
inline constexpr float kCounterFrom = 0.28f, kCounterTo = 1.02f; ///< along Z
inline constexpr float kCounterHalf = 1.5f;                      ///< along X

/// Return the height and the Z of the front edge of a roof, in the stall's frame.
Float2 frontEave(Roof roof);

/// String between two poles, which hangs through in a parabola.
struct LampString
{
    Float3 from, to;
    bool swings = false; ///< its lanterns move
};

/// Return the point of a string; 0 to 1 along it.
Float3 stringPoint(const LampString& string, float share);

/// Half axes and middle of a tree's crown in its frame, metres.
inline constexpr Float3 kCrownHalf{1.35f, 1.25f, 1.35f}, kCrownMiddle{0, 3.1f, 0};

struct Plan
{
    std::vector<Stall> stalls;
    std::vector<LampString> strings;
    std::vector<Float3> poles;         ///< feet
    std::vector<Placement> trees;      ///< of one scale along all axes
    std::vector<Placement> houses;     ///< the front is +Z, the foot of its middle the origin
    std::vector<Placement> lamp_posts; ///< the arm reaches along +Z
};

Plan makePlan();

} // namespace hearth::samples::market

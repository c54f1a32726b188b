// Lists the places of the market that can have a light: lamps, lanterns, candles, strings of bulbs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "sample_assets/market/plan.h"

namespace hearth::samples::market
{

enum class FixtureKind : uint32_t
{
    stall_lamp,   ///< below a roof, in a shade or bare
    lantern,      ///< of paper, on a string over a lane
    lamp_post,    ///< at the houses and in the outer lanes
    accent,       ///< narrow spot below a roof, on the goods
    sign,         ///< before a neon sign
    moving,       ///< swinging lanterns, the cart's lamps, fireflies
    eave_bulb,    ///< one of a string along a roof
    string_bulb,  ///< on a string over a lane, between lanterns
    candle,       ///< among goods
    tree_bulb,    ///< in the crown of a tree
    facade_bulb,  ///< along a house's ledge or eaves
    ground_candle ///< at the edge of the street
};
inline constexpr uint32_t kFixtureKinds = 12;

/// A place for a light, with a lamp that is drawn whether it has one or not.
struct Fixture
{
    FixtureKind kind = FixtureKind::stall_lamp;
    LightKind light = LightKind::point;
    Float3 position;            ///< of the lamp, in the frame of `node`, or in the world
    float light_drop = 0;       ///< metres that the light is below the lamp
    Float3 direction{0, -1, 0}; ///< unit; of a spot
    Float3 color{1, 1, 1};      ///< linear, largest channel 1
    float inner_cone_rad = 0;
    float outer_cone_rad = 0;
    float range = 3;     ///< metres, in a market of 192 lights
    float flicker = 0;   ///< amplitude; 0: steady
    int node = kNoIndex; ///< node that it moves with
    uint32_t look =
        0; ///< of a lantern or sign: its colour; of a stall lamp: 1 has a shade; of bulbs: 1 coloured, 2 cold
};

/// Linear colours of paper lanterns and their light.
inline constexpr std::array<Float3, kPaperCount> kPaperColors{{{1.0f, 0.10f, 0.035f},
                                                               {1.0f, 0.36f, 0.06f},
                                                               {1.0f, 0.60f, 0.20f},
                                                               {0.08f, 0.80f, 0.50f},
                                                               {0.55f, 0.12f, 1.0f},
                                                               {0.10f, 0.32f, 1.0f}}};
/// Linear colours of lamps with a filament, and of flames.
inline constexpr Float3 kBulbColor{1.0f, 0.66f, 0.34f}, kFlameColor{1.0f, 0.48f, 0.14f};

/// Place of the lamp of a stall, in the stall's frame.
inline constexpr Float3 kStallLamp{0, 1.98f, 0.62f};
/// Distance that the middle of a paper lantern hangs below its string, and that its light is below its
/// middle: paper is opaque to shadow maps, so that a light inside would light nothing. Metres.
inline constexpr float kLanternDrop = 0.42f, kLanternLightDrop = 0.40f;
/// Middle of the glass at the arm of a lamp post, in the post's frame, and the place of its light, below it.
inline constexpr Float3 kPostLamp{0, 3.42f, 0.62f}, kPostLight{0, 3.24f, 0.62f};

/// A neon sign: a board below a roof's edge or on a house.
struct Sign
{
    Placement placement; ///< the front is +Z
    uint32_t color = 0;  ///< of kPaperColors
};
std::vector<Sign> placeSigns(const Plan& plan);

/// Return all fixtures that rest. Those of a kind are in the order in which lights are given to them: any
/// first part of them is spread over the whole market.
std::vector<Fixture> placeFixtures(const Plan& plan);

/// Meshes and materials of lamps that other things have, too.
struct LampModels
{
    /// Paper lanterns about the origin that hang from (0, kLanternDrop, 0), by colour.
    std::array<int, kPaperCount> lanterns;
    int iron, bulb; ///< materials
};

/// Add the lamps of the fixtures that rest, and the signs' boards.
LampModels addLamps(Document& document, const Plan& plan, const std::vector<Fixture>& fixtures);

} // namespace hearth::samples::market

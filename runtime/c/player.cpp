// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace hearth;
using namespace hearth::c;

namespace
{

Result<pack::ClipTime> toClip(const hearth_player& player, const hearth_clip& clip)
{
    const size_t count = player.pack.pack.view().animations().size();
    if (clip.animation >= count)
        return usage("there is no animation " + std::to_string(clip.animation) + ": the pack has " +
                     std::to_string(count));
    if (!std::isfinite(clip.seconds))
        return usage("the seconds of a clip are not finite");
    return pack::ClipTime{clip.animation, clip.seconds};
}

Status goTo(hearth_player& player, const hearth_clip* from, const hearth_clip* to, double weight)
{
    if (from == nullptr && to != nullptr)
        return usage("to is blended with from, which is NULL");
    if (from == nullptr)
    {
        player.player.rest();
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(const pack::ClipTime first, toClip(player, *from));
    if (to == nullptr)
    {
        player.player.play(first);
        return success();
    }
    if (!(weight >= 0 && weight <= 1))
        return usage("weight is not from 0 to 1");
    HEARTH_ASSIGN_OR_RETURN(const pack::ClipTime second, toClip(player, *to));
    player.player.blend(first, second, weight);
    return success();
}

/// Convert the player's moves and poses to the types of hearth.h.
void refresh(hearth_player& player)
{
    player.moves.clear();
    for (const pack::MovedInstance& moved : player.player.moved())
    {
        hearth_move move{};
        move.instance = moved.instance;
        std::copy_n(&moved.world_from_object.m[0][0], 12, &move.world_from_object[0][0]);
        player.moves.push_back(move);
    }
}

hearth_light_change toChange(const pack::PlayedLight& played)
{
    const formats::LightRecord& record = played.record;
    hearth_light_change change{};
    change.light = played.light;
    std::copy_n(&record.world_from_light.m[0][0], 12, &change.world_from_light[0][0]);
    const float color[] = {record.color.x, record.color.y, record.color.z};
    std::copy_n(color, 3, change.color);
    change.intensity = record.intensity;
    change.range = record.range;
    change.inner_cone_rad = record.inner_cone_rad;
    change.outer_cone_rad = record.outer_cone_rad;
    change.steady_intensity = played.steady_intensity;
    return change;
}

/// Convert the light player's lights to the types of hearth.h. Allocates nothing: there is room for all.
void refreshLights(hearth_player& player)
{
    const auto convert =
        [](std::span<const pack::PlayedLight> lights, std::vector<hearth_light_change>& changes)
    {
        changes.clear();
        std::transform(lights.begin(), lights.end(), std::back_inserter(changes), toChange);
    };
    convert(player.light_player.changed(), player.changed_lights);
    convert(player.light_player.lights(), player.lights);
}

} // namespace

hearth_result hearth_pack_find_animation(const hearth_pack* pack, const char* name, uint32_t* animation,
                                         double* seconds, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (pack == nullptr || name == nullptr || animation == nullptr)
                        return usage("pack, name or animation is NULL");
                    const auto found = pack::findAnimation(pack->pack.view(), name);
                    if (!found)
                        return usage("the pack has no animation " + std::string(name));
                    *animation = *found;
                    if (seconds != nullptr)
                        *seconds = double{pack->pack.view().animations()[*found].duration};
                    return success();
                });
}

hearth_result hearth_player_create(hearth_pack* pack, hearth_player** player, char* message,
                                   size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (pack == nullptr || player == nullptr)
                        return usage("pack or player is NULL");
                    auto made = std::make_unique<hearth_player>(*pack);
                    made->moves.reserve(made->player.transforms().size());
                    for (const pack::PosedInstance& posed : made->player.posed())
                        made->poses.push_back(
                            {posed.instance, static_cast<uint32_t>(posed.world_from_bind.size()),
                             reinterpret_cast<const hearth_transform*>(posed.world_from_bind.data()),
                             posed.morph_weights.data(), static_cast<uint32_t>(posed.morph_weights.size()),
                             0});
                    refresh(*made);
                    made->changed_lights.reserve(made->light_player.lights().size());
                    made->lights.reserve(made->light_player.lights().size());
                    ++pack->player_count;
                    *player = made.release();
                    return success();
                });
}

hearth_result hearth_player_destroy(hearth_player* player)
{
    if (player == nullptr)
        return HEARTH_OK;
    const std::unique_ptr<hearth_player> dying(player);
    --dying->pack.player_count;
    return HEARTH_OK;
}

hearth_result hearth_player_go_to(hearth_player* player, const hearth_clip* from, const hearth_clip* to,
                                  double weight, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (player == nullptr)
                        return usage("player is NULL");
                    HEARTH_TRY(goTo(*player, from, to, weight));
                    refresh(*player);
                    return success();
                });
}

hearth_result hearth_player_get_info(const hearth_player* player, hearth_player_info* info)
{
    return call({}, __func__,
                [&]() -> Status
                {
                    if (player == nullptr)
                        return usage("player is NULL");
                    HEARTH_TRY(checkStruct("info", info));
                    *info = {.struct_size = sizeof(*info),
                             .move_count = static_cast<uint32_t>(player->moves.size()),
                             .moves = player->moves.data(),
                             .poses = player->poses.data(),
                             .pose_count = static_cast<uint32_t>(player->poses.size()),
                             .reserved = 0};
                    return success();
                });
}

hearth_result hearth_player_get_lights(hearth_player* player, double flicker_seconds,
                                       hearth_player_lights* lights, char* message, size_t message_size)
{
    return call({message, message_size}, __func__,
                [&]() -> Status
                {
                    if (player == nullptr)
                        return usage("player is NULL");
                    HEARTH_TRY(checkStruct("lights", lights));
                    if (!std::isfinite(flicker_seconds))
                        return usage("flicker_seconds is not finite");
                    player->light_player.update(player->player, flicker_seconds);
                    refreshLights(*player);
                    *lights = {.struct_size = sizeof(*lights),
                               .changed_count = static_cast<uint32_t>(player->changed_lights.size()),
                               .changed = player->changed_lights.data(),
                               .lights = player->lights.data(),
                               .light_count = static_cast<uint32_t>(player->lights.size()),
                               .reserved = 0};
                    return success();
                });
}

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/instance_motion.h"

#include "formats/base/scale_bound.h"

#include <cmath>
#include <cstring>
#include <string>

namespace hearth::gpu
{

namespace
{

bool isFinite(const Affine3& t)
{
    for (const auto& row : t.m)
        for (const float value : row)
            if (!std::isfinite(value))
                return false;
    return true;
}

/// True if a move leads to where the instance was at loading.
bool isAtRest(const Scene& scene, const InstanceMove& move)
{
    const Affine3& at_rest = scene.instances[move.instance].world_from_object;
    static_assert(sizeof(at_rest) == 3 * sizeof(Float4));
    return std::memcmp(&move.record.world_from_object_x, &at_rest, sizeof(at_rest)) == 0;
}

} // namespace

Result<InstanceMove> moveInstance(const Scene& scene, uint32_t instance, const Affine3& world_from_object)
{
    const auto fail = [&](const std::string& detail) {
        return Error{Issue::usage, "", "instance " + std::to_string(instance), detail};
    };
    if (instance >= scene.instances.size())
        return fail("there are " + std::to_string(scene.instances.size()));
    if (scene.deformation != nullptr && findDeformed(scene.deformation->layout, instance) != nullptr)
        return fail("it is deformed: its pose says where it is");
    if (!isFinite(world_from_object))
        return fail("its new transform is not finite");
    formats::InstanceRecord record = scene.instances[instance];
    const bool mirrored = (record.flags & formats::kInstanceMirrored) != 0;
    if (const float volume = determinant(world_from_object); volume != 0 && (volume < 0) != mirrored)
        record.flags = (record.flags ^ formats::kInstanceMirrored) | shared::kInstanceHandednessChanged;
    record.world_from_object = world_from_object;
    record.scale_max = scaleBound(world_from_object);
    record.flags |= shared::kInstanceMoved;
    InstanceMove move{.instance = instance, .record = {}, .inverse = shared::makeInstanceInverse(record)};
    static_assert(sizeof(move.record) == sizeof(record));
    std::memcpy(static_cast<void*>(&move.record), &record, sizeof(record));
    return move;
}

void takeMoves(const Scene& scene, std::span<const InstanceMove> moves)
{
    for (const InstanceMove& move : moves)
    {
        scene.tables->instances.writeRow(move.instance, move.record);
        scene.tables->inverses.writeRow(move.instance, move.inverse);
        if (scene.receivers != nullptr)
            writeReceiverRow(scene, move.instance,
                             scene.receivers->takeMove(move.instance, isAtRest(scene, move)));
    }
}

} // namespace hearth::gpu

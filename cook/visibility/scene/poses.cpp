// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/poses.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hearth::visibility
{

using namespace formats;

namespace
{

/// Format seconds, such as "0.25", with the fewest digits that read back as the same float.
std::string formatSeconds(double seconds)
{
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof(buffer), static_cast<float>(seconds)).ptr};
}

const AnimationRecord* findClip(const PackView& scene, const std::string& name)
{
    uint32_t index = kInvalidIndex;
    std::from_chars(name.data(), name.data() + name.size(), index);
    for (uint32_t i = 0; i < scene.animations().size(); ++i)
    {
        const std::string_view text = scene.text(scene.animations()[i].name);
        if (text.empty() ? i == index : text == name)
            return &scene.animations()[i];
    }
    return nullptr;
}

Error missingClipError(const PackView& scene, const std::string& name)
{
    std::string names;
    for (uint32_t i = 0; i < scene.animations().size(); ++i)
    {
        const std::string_view text = scene.text(scene.animations()[i].name);
        names += (i == 0 ? "" : ", ") + (text.empty() ? std::to_string(i) : std::string(text));
    }
    return Error{Issue::meaning_reference, scene.name(), "animation \"" + name + "\"",
                 names.empty() ? "there are no animations"
                               : "there is none of this name: there are " + names};
}

/// Find the node of the mesh's first instance, else any node that has the mesh.
uint32_t findNode(const PackView& scene, uint32_t mesh)
{
    for (const InstanceRecord& instance : scene.instances())
        if (instance.mesh == mesh)
            return instance.node;
    for (uint32_t node = 0; node < scene.nodes().size(); ++node)
        if (scene.nodes()[node].mesh == mesh)
            return node;
    return kInvalidIndex;
}

std::vector<Affine3d> computePalette(const PackView& scene, uint32_t skin, const ScenePose& pose)
{
    const AnimationTables tables = animationTables(scene);
    std::vector<Affine3d> nodes(tables.nodes.size());
    poseNodes(tables, pose, nodesParentsFirst(tables.nodes), nodes);
    const SkinRecord& record = tables.skins[skin];
    std::vector<Affine3d> palette(record.joints.count);
    skinPalette(tables, record, nodes, palette);
    return palette;
}

Double3 skinPosition(const ClusterGeometry& geometry, uint32_t vertex, std::span<const Affine3d> palette,
                     Double3 p)
{
    const std::array<uint32_t, 8> joints = geometry.joints(vertex);
    const std::array<uint32_t, 8> codes = geometry.weightCodes(vertex);
    Double3 sum;
    for (size_t i = 0; i < geometry.influenceCount(); ++i)
        if (codes[i] != 0 && joints[i] < palette.size())
            sum = sum + transformPoint(palette[joints[i]], p) * (codes[i] / 65535.0);
    return sum;
}

} // namespace

std::optional<ClipTimes> parseClipTimes(std::string_view text)
{
    const size_t at = text.rfind('@');
    if (at == std::string_view::npos)
        return ClipTimes{std::string(text), {}};
    ClipTimes times{std::string(text.substr(0, at)), {}};
    for (const char* next = text.data() + at + 1;; ++next)
    {
        double seconds = 0;
        const auto [end, error] = std::from_chars(next, text.data() + text.size(), seconds);
        if (error != std::errc{} || !std::isfinite(seconds) || seconds < 0)
            return std::nullopt;
        times.seconds.push_back(seconds);
        next = end;
        if (next == text.data() + text.size())
            return times;
        if (*next != ',')
            return std::nullopt;
    }
}

Result<std::vector<NamedPose>> samplePoses(const PackView& scene, const std::vector<ClipTimes>& clips)
{
    const AnimationTables tables = animationTables(scene);
    std::vector<NamedPose> poses;
    for (const ClipTimes& times : clips)
    {
        const AnimationRecord* clip = findClip(scene, times.clip);
        if (clip == nullptr)
            return missingClipError(scene, times.clip);
        std::vector<double> seconds = times.seconds;
        for (size_t i = 0; i < kDefaultPosesPerClip && times.seconds.empty(); ++i)
            seconds.push_back((static_cast<double>(i) + 0.5) / kDefaultPosesPerClip * double{clip->duration});
        for (const double time : seconds)
        {
            poses.push_back({times.clip + "@" + formatSeconds(time), restPose(tables)});
            sampleAnimation(tables, *clip, time, poses.back().pose);
        }
    }
    return poses;
}

std::vector<Float3> posedPositions(const PackView& scene, const MeshPages& pages, const LevelArrays& finest,
                                   uint32_t mesh, const ScenePose& pose)
{
    const uint32_t number = findNode(scene, mesh);
    if (number == kInvalidIndex)
        return {};
    const NodeRecord& node = scene.nodes()[number];
    const std::span<const double> weights =
        recordsInRange(std::span<const double>(pose.morph_weights), node.morph_weights);
    const std::vector<Affine3d> palette =
        node.skin == kInvalidIndex ? std::vector<Affine3d>() : computePalette(scene, node.skin, pose);
    std::vector<Float3> positions;
    positions.reserve(finest.positions.size());
    for (const LevelArrays::Part& part : finest.parts)
    {
        const ClusterGeometry geometry = pages.cluster(part.cluster);
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        {
            Double3 p = widen(geometry.position(v));
            for (uint32_t i = 0; i < geometry.morphCount(); ++i)
                if (const uint32_t target = geometry.morphTarget(i); target < weights.size())
                    p = p + widen(geometry.morphPosition(i, v)) * weights[target];
            if (!palette.empty() && geometry.influenceCount() > 0)
                p = skinPosition(geometry, v, palette, p);
            positions.push_back(narrow(p));
        }
    }
    return positions;
}

} // namespace hearth::visibility

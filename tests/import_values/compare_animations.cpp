// Compares the keys of animation channels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/compare_part.h"

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

constexpr double kRounding = 1.2e-7;

size_t countTargets(const tinygltf::Model& model, int node)
{
    const int mesh = model.nodes.at(static_cast<size_t>(node)).mesh;
    size_t count = 0;
    if (mesh >= 0)
        for (const tinygltf::Primitive& primitive : model.meshes.at(static_cast<size_t>(mesh)).primitives)
            count = std::max(count, primitive.targets.size());
    return count;
}

/// Numbers of a value that a channel animates; 0: the part has no such channel.
size_t countComponents(const tinygltf::Model& model, const tinygltf::AnimationChannel& channel)
{
    if (channel.target_path == "weights")
        return countTargets(model, channel.target_node);
    return channel.target_path == "rotation"                                        ? 4
           : channel.target_path == "translation" || channel.target_path == "scale" ? 3
                                                                                    : 0;
}

uint32_t pathNumber(const std::string& path)
{
    return path == "translation" ? 0u : path == "rotation" ? 1u : path == "scale" ? 2u : 3u;
}

uint32_t interpolationNumber(const std::string& name)
{
    return name == "STEP" ? 0u : name == "CUBICSPLINE" ? 2u : 1u;
}

/// Return the keys whose time is greater than that of all keys before.
std::vector<size_t> growingKeys(const SourceValues& times)
{
    std::vector<size_t> keys;
    for (size_t i = 0; i < times.values.size(); ++i)
        if (keys.empty() || times.values[i] > times.values[keys.back()])
            keys.push_back(i);
    return keys;
}

/// Compares one channel.
class ChannelComparison
{
public:
    ChannelComparison(const formats::PackView& part, const formats::AnimationChannelRecord& record,
                      size_t index, Comparison& comparison)
        : part_(part), record_(record), index_(index), comparison_(comparison)
    {
    }

    void compare(const SourceValues& times, const SourceValues& values)
    {
        const std::vector<size_t> keys = growingKeys(times);
        comparison_.checkEqual(static_cast<long long>(keys.size()), record_.key_count, "keys of channel",
                               index_);
        comparison_.checkEqual(0, record_.encoding, "encoding of channel", index_);
        if (keys.size() != record_.key_count || record_.encoding != 0)
            return;
        const size_t rows = record_.interpolation == 2 ? 3 : 1;
        for (size_t key = 0; key < keys.size(); ++key)
        {
            comparison_.check(Value::key_time, times.values[keys[key]],
                              double{part_.keys()[record_.first_time + key]}, 0, "of channel", index_);
            for (size_t row = 0; row < rows; ++row)
                compareRow(values, keys[key] * rows + row, key * rows + row, rows == 1 || row == 1);
        }
    }

private:
    /// is_value  a value, not a tangent of a spline: rotations have length 1
    void compareRow(const SourceValues& values, size_t from, size_t to, bool is_value)
    {
        const size_t components = record_.components;
        double scale = 1;
        const bool is_turned = record_.path == 1 && is_value;
        if (is_turned)
        {
            double square = 0;
            for (size_t i = 0; i < 4; ++i)
                square += values.values.at(from * 4 + i) * values.values.at(from * 4 + i);
            scale = 1 / std::sqrt(square);
        }
        for (size_t i = 0; i < components; ++i)
        {
            const double value = values.values.at(from * components + i) * scale;
            const double slack = is_turned ? 2e-7 : values.is_exact ? 0.0 : kRounding * std::abs(value);
            comparison_.check(Value::key_value, value,
                              double{part_.keys()[record_.first_value + to * components + i]}, slack,
                              "of channel", index_);
        }
    }

    const formats::PackView& part_;
    const formats::AnimationChannelRecord& record_;
    size_t index_;
    Comparison& comparison_;
};

} // namespace

void compareAnimations(const SourceModel& source, const formats::PackView& part, Comparison& comparison)
{
    const tinygltf::Model& model = source.model;
    comparison.checkEqual(static_cast<long long>(model.animations.size()),
                          static_cast<long long>(part.animations().size()), "number of animations", 0);
    size_t index = 0;
    for (size_t i = 0; i < std::min(model.animations.size(), part.animations().size()); ++i)
    {
        const formats::Range range = part.animations()[i].channels;
        comparison.checkEqual(static_cast<long long>(index), range.first, "first channel of animation", i);
        for (const tinygltf::AnimationChannel& channel : model.animations[i].channels)
        {
            const size_t components = countComponents(model, channel);
            if (components == 0)
                continue;
            if (index >= part.channels().size())
                return comparison.fail("channels are missing");
            const formats::AnimationChannelRecord& record = part.channels()[index];
            const tinygltf::AnimationSampler& sampler =
                model.animations[i].samplers.at(static_cast<size_t>(channel.sampler));
            comparison.checkEqual(channel.target_node, record.target, "node of channel", index);
            comparison.checkEqual(pathNumber(channel.target_path), record.path, "path of channel", index);
            comparison.checkEqual(static_cast<long long>(components), record.components,
                                  "components of channel", index);
            comparison.checkEqual(interpolationNumber(sampler.interpolation), record.interpolation,
                                  "interpolation of channel", index);
            if (components == record.components)
                ChannelComparison(part, record, index, comparison)
                    .compare(readValues(source, sampler.input), readValues(source, sampler.output));
            ++index;
        }
        comparison.checkEqual(static_cast<long long>(index), range.first + range.count,
                              "channels of animation", i);
        // tinygltf knows no targets but nodes
        index += part.animations()[i].light_channels.count;
    }
}

} // namespace hearth::test

// Compares the vertices of compressed clips with vertices of the source's clips at many times.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/clip_settings.h"
#include "cook/animation_compression/compress.h"
#include "formats/codecs/channel_keys.h"
#include "formats/pack/pack_view.h"
#include "tests/cook/animation/random_characters.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include <tbb/global_control.h>

namespace hearth::test
{

namespace
{

using namespace formats;
using animation_bounds::Box3d;
using animation_compression::AttachedVertices;
using animation_compression::CompressedClips;
using animation_compression::StatedError;

// Error of double precision, relative to a vertex's distance from the origin.
constexpr double kRounding = 1e-13;

/// Return the vertices attached to each joint of a character's mesh, for morph weights from -1 to 2.
std::vector<AttachedVertices> carriedBy(const Character& character)
{
    constexpr double kMaxWeight = 2;
    std::vector<Box3d> boxes(character.joints.size());
    for (const skinning::DeformedCluster& cluster : character.mesh.clusters)
        for (size_t i = 0; i < cluster.joints.size(); ++i)
        {
            const size_t v = i / cluster.influences;
            double moved = 0;
            for (const skinning::MorphDeltas& morph : cluster.morphs)
                moved += kMaxWeight * length(widen(morph.positions[v]));
            if (cluster.weights[i] > 0)
                for (const double side : {-moved, moved})
                    add(boxes[cluster.joints[i]], widen(cluster.positions[v]) + Double3{side, side, side});
        }
    std::vector<AttachedVertices> carried;
    for (size_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i][0].empty())
            carried.push_back(
                {character.joints[i].node, widened(character.joints[i].joint_from_bind), boxes[i]});
    return carried;
}

std::vector<Double3> placesAt(const Character& character, const AnimationTables& tables,
                              const AnimationRecord& animation, double time)
{
    ScenePose pose = restPose(tables);
    sampleAnimation(tables, animation, time, pose);
    std::vector<Affine3d> world(tables.nodes.size()), palette(tables.joints.size());
    poseNodes(tables, pose, nodesParentsFirst(tables.nodes), world);
    skinPalette(tables, tables.skins[0], world, palette);
    std::vector<Double3> places;
    for (const skinning::DeformedCluster& cluster : character.mesh.clusters)
        for (size_t v = 0; v < cluster.positions.size(); ++v)
        {
            Double3 bound = widen(cluster.positions[v]);
            for (const skinning::MorphDeltas& morph : cluster.morphs)
                bound = bound + widen(morph.positions[v]) * pose.morph_weights[morph.target];
            Double3 place;
            for (size_t i = v * cluster.influences; i < (v + 1) * cluster.influences; ++i)
                place = place + transformPoint(palette[cluster.joints[i]], bound) * cluster.weights[i];
            places.push_back(place);
        }
    return places;
}

/// Return random times, all key times, and the floats next to these.
std::vector<double> chooseTimes(const Character& character, const AnimationRecord& animation, size_t count,
                                uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-0.1, double{animation.duration} * 1.1 + 0.1);
    std::vector<double> times;
    for (size_t i = 0; i < count; ++i)
        times.push_back(any(random));
    for (const AnimationChannelRecord& channel :
         recordsInRange(std::span<const AnimationChannelRecord>(character.channels), animation.channels))
        for (uint32_t key = 0; key < channel.key_count; ++key)
        {
            const float time = character.keys[channel.first_time + key];
            const float far = std::numeric_limits<float>::infinity();
            for (const float near : {time, std::nextafter(time, far), std::nextafter(time, -far)})
                times.push_back(double{near});
        }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

AnimationTables makeTables(const Character& character, const CompressedClips& clips)
{
    AnimationTables tables = character.tables();
    tables.animations = clips.animations;
    tables.channels = clips.tables.channels;
    tables.keys = clips.tables.keys;
    tables.key_bits = clips.tables.key_bits;
    return tables;
}

struct Figures
{
    double worst_share = 0; ///< relative to the proven error
    uint64_t bytes_before = 0, bytes_after = 0;
    uint32_t keys_before = 0, keys_after = 0;
    size_t packed = 0;
};

/// Compare compressed clips with the source's: sampled error <= proven error <= stated error.
Figures check(const Character& character, const StatedError& stated, size_t times, uint32_t seed)
{
    Figures figures;
    const AnimationTables source = character.tables();
    const std::vector<AttachedVertices> carried = carriedBy(character);
    const CompressedClips compressed = animation_compression::compressClips(source, carried, stated);
    const AnimationTables tables = makeTables(character, compressed);
    for (const AnimationChannelRecord& channel : tables.channels)
        figures.packed += isPacked(channel) ? 1u : 0u;
    for (size_t clip = 0; clip < source.animations.size(); ++clip)
    {
        const animation_compression::ClipStatistics& statistics = compressed.statistics[clip];
        EXPECT_LE(statistics.proven_error, statistics.stated_error * (1 + 1e-9));
        EXPECT_GE(double{tables.animations[clip].error}, statistics.proven_error);
        EXPECT_LE(statistics.bytes_after, statistics.bytes_before);
        double worst = 0, slack = 0;
        for (const double time : chooseTimes(character, source.animations[clip], trials(times), seed))
        {
            const auto wanted = placesAt(character, source, source.animations[clip], time);
            const auto is = placesAt(character, tables, tables.animations[clip], time);
            for (size_t v = 0; v < wanted.size(); ++v)
            {
                slack = std::max(slack, kRounding * length(wanted[v]));
                worst = std::max(worst, length(wanted[v] - is[v]));
            }
            if (worst > statistics.proven_error + slack)
            {
                ADD_FAILURE() << "clip " << clip << " at " << time << ": off by " << worst << ", proven "
                              << statistics.proven_error;
                break;
            }
        }
        if (statistics.proven_error > 0)
            figures.worst_share = std::max(figures.worst_share, worst / statistics.proven_error);
        figures.bytes_before += statistics.bytes_before;
        figures.bytes_after += statistics.bytes_after;
        figures.keys_before += statistics.keys_before;
        figures.keys_after += statistics.keys_after;
    }
    return figures;
}

/// Resample the same motion with a key every 1 / 60 s, as exporters write it.
Character baked(const Character& character)
{
    constexpr uint32_t kKeys = 61;
    Character result = character;
    result.keys.clear();
    for (uint32_t key = 0; key < kKeys; ++key)
        result.keys.push_back(static_cast<float>(key) / 60.0f);
    const AnimationTables tables = character.tables();
    for (size_t c = 0; c < result.channels.size(); ++c)
    {
        AnimationChannelRecord& channel = result.channels[c];
        channel.key_count = kKeys;
        channel.first_time = 0;
        channel.first_value = static_cast<uint32_t>(result.keys.size());
        channel.interpolation = static_cast<uint32_t>(Interpolation::linear);
        AnimationRecord alone{};
        alone.channels = {static_cast<uint32_t>(c), 1};
        for (uint32_t key = 0; key < kKeys; ++key)
        {
            ScenePose pose = restPose(tables);
            sampleAnimation(tables, alone, double{result.keys[key]}, pose);
            const NodePose& node = pose.nodes[channel.target];
            const auto push = [&](double value) { result.keys.push_back(static_cast<float>(value)); };
            const Double3 vector =
                channel.path == static_cast<uint32_t>(AnimationPath::scale) ? node.scale : node.translation;
            if (channel.path == static_cast<uint32_t>(AnimationPath::weights))
                std::for_each(pose.morph_weights.begin(), pose.morph_weights.end(), push);
            else if (channel.path == static_cast<uint32_t>(AnimationPath::rotation))
                std::for_each(node.rotation.begin(), node.rotation.end(), push);
            else
                for (const double value : {vector.x, vector.y, vector.z})
                    push(value);
        }
    }
    return result;
}

/// Scale the scene to other units.
void scaleUnits(Character& character, float scale)
{
    for (NodeRecord& node : character.nodes)
        node.translation = node.translation * scale;
    for (JointRecord& joint : character.joints)
        for (auto& row : joint.joint_from_bind.m)
            row[3] *= scale;
    for (const AnimationChannelRecord& channel : character.channels)
        if (channel.path == static_cast<uint32_t>(AnimationPath::translation))
            for (uint32_t i = 0; i < channel.key_count * 3 * (channel.interpolation == 2 ? 3 : 1); ++i)
                character.keys[channel.first_value + i] *= scale;
    for (skinning::DeformedCluster& cluster : character.mesh.clusters)
    {
        for (Float3& position : cluster.positions)
            position = position * scale;
        for (skinning::MorphDeltas& morph : cluster.morphs)
            for (Float3& delta : morph.positions)
                delta = delta * scale;
    }
}

constexpr StatedError kDefault{0, animation_compression::kDefaultShareOfSize};

} // namespace

TEST(CompressClips, staysWithinTheProvenErrorAtAllTimes)
{
    CharacterSpec spec;
    spec.clips = 1;
    spec.keys = 9;
    spec.scale_low = 0.5;
    spec.scale_high = 1.5;
    spec.matrices = true;
    spec.far_influences = true;
    spec.opposite = true;
    for (const bool splines : {false, true})
    {
        spec.splines = splines;
        double worst_share = 0;
        for (uint32_t seed = 0; seed < 4; ++seed)
            for (const StatedError stated : {kDefault, StatedError{1e-3, 0}, StatedError{0.05, 0}})
            {
                const Figures figures = check(randomCharacter(spec, seed), stated, 2500, seed);
                worst_share = std::max(worst_share, figures.worst_share);
            }
        // a bound that is never nearly reached would pass whatever the clips do
        EXPECT_GT(worst_share, 0.02);
    }
}

TEST(CompressClips, keepsFewKeysOfBakedMotion)
{
    CharacterSpec spec;
    spec.clips = 2;
    for (uint32_t seed = 0; seed < 3; ++seed)
    {
        const Character character = baked(randomCharacter(spec, seed));
        const Figures tight = check(character, kDefault, 2000, seed);
        const Figures loose = check(character, {1e-3, 0}, 10000, seed);
        EXPECT_GT(tight.packed, 0u);
        EXPECT_LT(tight.bytes_after, tight.bytes_before / 2);
        EXPECT_LT(loose.bytes_after, tight.bytes_after * 9 / 10);
        EXPECT_LT(loose.keys_after, tight.keys_before / 2);
        EXPECT_GT(loose.worst_share, 0.02);
    }
}

TEST(CompressClips, boundsSpinsByNearlyHalfATurn)
{
    CharacterSpec spec;
    spec.spins = spec.mirrored = spec.several_roots = true;
    spec.clips = 2;
    spec.keys = 12;
    for (uint32_t seed = 10; seed < 16; ++seed)
        for (const StatedError stated : {kDefault, StatedError{0.01, 0}, StatedError{1, 0}})
            check(randomCharacter(spec, seed), stated, 2000, seed);
}

TEST(CompressClips, addsUpErrorsOfLongChains)
{
    CharacterSpec spec;
    spec.joints = 200;
    spec.clips = 1;
    spec.swing = 0.2;
    spec.influences = 2;
    for (const StatedError stated : {kDefault, StatedError{0.01, 0}})
    {
        const Figures figures = check(baked(randomCharacter(spec, 3)), stated, 300, 3);
        EXPECT_LT(figures.bytes_after, figures.bytes_before);
    }
}

TEST(CompressClips, isTheSameInAllUnits)
{
    CharacterSpec spec;
    spec.clips = 1;
    const Character metres = baked(randomCharacter(spec, 5));
    const Figures wanted = check(metres, kDefault, 1000, 5);
    for (const float scale : {1e-4f, 1e4f})
    {
        Character character = metres;
        scaleUnits(character, scale);
        const Figures figures = check(character, kDefault, 1000, 5);
        EXPECT_NEAR(static_cast<double>(figures.bytes_after), static_cast<double>(wanted.bytes_after),
                    0.02 * static_cast<double>(wanted.bytes_after))
            << scale;
    }
}

TEST(CompressClips, keepsJumpsAndNearTimes)
{
    CharacterSpec spec;
    spec.clips = 1;
    spec.keys = 8;
    for (const bool splines : {false, true})
        for (uint32_t seed = 20; seed < 24; ++seed)
        {
            spec.splines = splines;
            Character character = randomCharacter(spec, seed);
            std::mt19937 random(seed);
            for (const AnimationChannelRecord& channel : character.channels)
                for (uint32_t key = 1; key < channel.key_count; ++key)
                {
                    float* const time = &character.keys[channel.first_time + key];
                    if (random() % 3 == 0)
                        time[0] = time[-1];
                    else if (random() % 3 == 0)
                        time[0] = std::nextafter(time[-1], 1e9f);
                }
            for (const StatedError stated : {kDefault, StatedError{0.01, 0}})
                check(character, stated, 2000, seed);
        }
}

TEST(CompressClips, oneKeyIsOneValue)
{
    CharacterSpec spec;
    spec.keys = 1;
    spec.morph_targets = 2;
    const Figures figures = check(randomCharacter(spec, 7), kDefault, 100, 7);
    EXPECT_EQ(figures.packed, 0u);
}

TEST(CompressClips, withoutAnErrorPosesAreThoseOfTheSource)
{
    CharacterSpec spec;
    spec.keys = 7;
    spec.morph_targets = 3;
    for (const bool splines : {false, true})
    {
        spec.splines = splines;
        const Character character = randomCharacter(spec, 8);
        const CompressedClips exact =
            animation_compression::compressClips(character.tables(), carriedBy(character), {});
        const AnimationTables tables = makeTables(character, exact);
        EXPECT_EQ(tables.animations[0].error, 0);
        EXPECT_TRUE(tables.key_bits.empty());
        for (size_t clip = 0; clip < character.animations.size(); ++clip)
            for (const double time : chooseTimes(character, character.animations[clip], 500, 8))
            {
                ScenePose wanted = restPose(tables), is = wanted;
                sampleAnimation(character.tables(), character.animations[clip], time, wanted);
                sampleAnimation(tables, tables.animations[clip], time, is);
                EXPECT_EQ(is.morph_weights, wanted.morph_weights);
                for (size_t node = 0; node < is.nodes.size(); ++node)
                {
                    EXPECT_EQ(is.nodes[node].rotation, wanted.nodes[node].rotation);
                    EXPECT_EQ(length(is.nodes[node].translation - wanted.nodes[node].translation), 0);
                    EXPECT_EQ(length(is.nodes[node].scale - wanted.nodes[node].scale), 0);
                }
            }
    }
}

TEST(CompressClips, keepsMorphWeightsExactly)
{
    CharacterSpec spec;
    spec.keys = 7;
    spec.morph_targets = 3;
    const Character character = randomCharacter(spec, 9);
    const CompressedClips loose =
        animation_compression::compressClips(character.tables(), carriedBy(character), {0.1, 0});
    const AnimationTables tables = makeTables(character, loose);
    for (const double time : chooseTimes(character, character.animations[0], 500, 9))
    {
        ScenePose wanted = restPose(tables), is = wanted;
        sampleAnimation(character.tables(), character.animations[0], time, wanted);
        sampleAnimation(tables, tables.animations[0], time, is);
        EXPECT_EQ(is.morph_weights, wanted.morph_weights);
    }
}

TEST(CompressClips, channelsThatDoNothingGo)
{
    CharacterSpec spec;
    spec.clips = 1;
    spec.morph_targets = 2;
    Character character = baked(randomCharacter(spec, 11));
    for (const AnimationChannelRecord& channel : character.channels)
    {
        const NodeRecord& node = character.nodes[channel.target];
        const Float4 rotation = node.rotation;
        for (uint32_t key = 0; key < channel.key_count; ++key)
            for (uint32_t i = 0; i < channel.components; ++i)
                character.keys[channel.first_value + key * channel.components + i] =
                    channel.path == 0   ? node.translation[static_cast<int>(i)]
                    : channel.path == 1 ? std::array{rotation.x, rotation.y, rotation.z, rotation.w}[i]
                    : channel.path == 2 ? node.scale[static_cast<int>(i)]
                                        : 0.25f;
    }
    const CompressedClips compressed =
        animation_compression::compressClips(character.tables(), carriedBy(character), kDefault);
    EXPECT_TRUE(compressed.tables.channels.empty());
    EXPECT_LE(compressed.statistics[0].proven_error, 1e-13);
}

TEST(CompressClips, channelsOfLightsStay)
{
    CharacterSpec spec;
    spec.clips = 2;
    Character character = baked(randomCharacter(spec, 13));
    const std::vector<AnimationChannelRecord> of_nodes = character.channels;
    character.channels.clear();
    for (AnimationRecord& animation : character.animations)
    {
        const auto channels =
            recordsInRange(std::span<const AnimationChannelRecord>(of_nodes), animation.channels);
        animation.channels.first = static_cast<uint32_t>(character.channels.size());
        character.channels.insert(character.channels.end(), channels.begin(), channels.end());
        AnimationChannelRecord channel{};
        channel.target = 1000; // lights are not in these tables
        channel.path = static_cast<uint32_t>(AnimationPath::light_intensity);
        channel.interpolation = static_cast<uint32_t>(Interpolation::cubic_spline);
        channel.components = 1;
        channel.key_count = 2;
        channel.first_value = static_cast<uint32_t>(character.keys.size());
        character.keys.insert(character.keys.end(), {0, 5, 1, -1, 6, 0});
        animation.light_channels = {static_cast<uint32_t>(character.channels.size()), 2};
        character.channels.insert(character.channels.end(), {channel, channel});
    }
    for (const StatedError& stated : {kDefault, StatedError{}})
    {
        const CompressedClips compressed =
            animation_compression::compressClips(character.tables(), carriedBy(character), stated);
        for (const AnimationRecord& animation : compressed.animations)
        {
            EXPECT_EQ(animation.light_channels.first, animation.channels.first + animation.channels.count);
            ASSERT_EQ(animation.light_channels.count, 2u);
            const AnimationChannelRecord& channel =
                compressed.tables.channels[animation.light_channels.first + 1];
            EXPECT_EQ(channel.target, 1000u);
            const ChannelKeys keys(compressed.tables.keys, compressed.tables.key_bits, channel);
            EXPECT_EQ(keys.value(0, 0, 1)[0], 5);
            EXPECT_EQ(keys.outTangent(0, 0, 1)[0], 1);
            EXPECT_EQ(keys.inTangent(1, 0, 1)[0], -1);
            EXPECT_EQ(keys.value(1, 0, 1)[0], 6);
            EXPECT_EQ(keys.time(1), character.keys[1]);
        }
        const auto& last = compressed.animations.back();
        EXPECT_EQ(last.light_channels.first + 2, compressed.tables.channels.size());
    }
}

TEST(CompressClips, isTheSameForAnyNumberOfThreads)
{
    CharacterSpec spec;
    spec.clips = 6;
    const Character character = baked(randomCharacter(spec, 12));
    const auto alone = [&]
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        return animation_compression::compressClips(character.tables(), carriedBy(character), kDefault);
    }();
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    const CompressedClips together =
        animation_compression::compressClips(character.tables(), carriedBy(character), kDefault);
    EXPECT_EQ(together.tables.keys, alone.tables.keys);
    EXPECT_EQ(together.tables.key_bits, alone.tables.key_bits);
    EXPECT_EQ(std::memcmp(together.tables.channels.data(), alone.tables.channels.data(),
                          alone.tables.channels.size() * sizeof(AnimationChannelRecord)),
              0);
}

TEST(ReadStatedError, readsMetresOrTakesTheDefault)
{
    const TemporaryFolder folder;
    const std::string path = folder.file("profile.toml");
    const auto read = [&](const char* text)
    {
        std::ofstream(path) << text;
        return animation_compression::readStatedError(path);
    };
    EXPECT_EQ(read("")->share_of_size, animation_compression::kDefaultShareOfSize);
    EXPECT_EQ(read("[clusters]\nnormal_bits = 8\n")->share_of_size,
              animation_compression::kDefaultShareOfSize);
    EXPECT_EQ(read("[animation]\n")->share_of_size, animation_compression::kDefaultShareOfSize);
    EXPECT_EQ(read("[animation]\nerror = 0.002\n")->metres, 0.002);
    EXPECT_EQ(read("[animation]\nerror = 0.002\n")->share_of_size, 0);
    EXPECT_EQ(read("[animation]\nerror = 1\n")->metres, 1);
    EXPECT_EQ(read("[animation]\nerror = 0\n")->metres, 0);
    for (const char* wrong :
         {"[animation]\nerror = -1\n", "[animation]\nerror = nan\n", "[animation]\nerror = inf\n",
          "[animation]\nerror = \"1\"\n", "[animation]\nerror = true\n", "animation = 3\n"})
        EXPECT_EQ(read(wrong).error().issue, Issue::profile_value) << wrong;
    const auto unknown = read("[animation]\n\neror = 1\n");
    EXPECT_EQ(unknown.error().issue, Issue::profile_key);
    EXPECT_EQ(unknown.error().where, "line 3, animation.eror");
    EXPECT_EQ(unknown.error().detail, "this key is not known: did you mean 'error'?");
    EXPECT_EQ(read("[animation\n").error().issue, Issue::profile_syntax);
    EXPECT_EQ(animation_compression::readStatedError(folder.file("none")).error().issue,
              Issue::input_missing);
}

} // namespace hearth::test

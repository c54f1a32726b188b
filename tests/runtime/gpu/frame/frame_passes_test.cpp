// Tests the table of a frame: a simulation of tiles and memory judges what it loads and stores, the lint
// finds planted errors of each rule, and bytes a pixel stay within their limits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_lint.h"
#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/frame/frame_text.h"
#include "runtime/gpu/frame/frame_way.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace hearth::test
{

namespace
{

using namespace gpu;

/// All configurations, of scenes with everything and of scenes with nothing.
std::vector<FrameConfiguration> everyConfiguration()
{
    std::vector<FrameConfiguration> all;
    std::mt19937 random(1);
    for (const FrameWay way : kFrameWays)
        for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
            for (FrameConfiguration c : allConfigurations(way, materials))
                for (const bool rich : {false, true})
                {
                    c.lights_bricks = rich;
                    if (rich)
                        addMapsOfAllKinds(c);
                    // lists of lights: of cells, of slots, or of what pixels show
                    const uint32_t lists = random() % 4;
                    c.lists_lights = lists > 0;
                    c.lists_slots = lists == 2;
                    c.lists_visible = lists == 3;
                    all.push_back(c);
                    if (materials == MaterialTest::id)
                        all.emplace_back(c).keeps_depth = true;
                    // what follows shading does not depend on what lies before it: some have a final pass
                    if (random() % 8 != 0)
                        continue;
                    FrameConfiguration finished = c;
                    finished.has_final_pass = true;
                    finished.adapts_exposure = random() % 2 != 0;
                    finished.blooms = random() % 2 != 0;
                    all.push_back(finished);
                    if (materials != MaterialTest::id)
                        continue;
                    finished.radiance_format = VK_FORMAT_R16G16B16A16_SFLOAT;
                    for (const LightPath path : {LightPath::light_sums, LightPath::joint_sums,
                                                 LightPath::encoded_joint_sums, LightPath::light_bits})
                    {
                        FrameConfiguration& ahead = all.emplace_back(random() % 2 != 0 ? c : finished);
                        ahead.radiance_format = VK_FORMAT_R16G16B16A16_SFLOAT;
                        ahead.light_path = path;
                    }
                    finished.light_path = LightPath::surfaces;
                    all.push_back(finished);
                    finished.light_path = LightPath::surfaces_on_tile;
                    finished.blooms = finished.adapts_exposure = false;
                    all.push_back(finished);
                }
    return all;
}

/// Return all of them or, under a sanitizer, a sample.
std::vector<FrameConfiguration> sampleConfigurations()
{
    std::vector<FrameConfiguration> all = everyConfiguration(), sample;
    for (size_t i = 0; i < all.size(); i += kSanitized ? 11 : 1)
        sample.push_back(all[i]);
    return sample;
}

std::string nameConfiguration(const FrameConfiguration& c)
{
    return formatFrameJson(describeFrame(c)).substr(0, 250);
}

/// Runs a frame on symbols: a version for each content that a resource ever has. A tile begins with nothing
/// and gets what is loaded, memory gets what is stored; a step that reads must find the last version.
class Simulation
{
public:
    /// Return true if every read of two such frames finds what was written last.
    bool run(const FrameDescription& frame)
    {
        memory_.clear();
        latest_.clear();
        const bool holds = runFrame(frame);
        return runFrame(frame) && holds;
    }

private:
    using Name = std::pair<FrameResource, uint32_t>; // and layer, of a shadow map
    using Contents = std::map<Name, int>;            // version; absent: undefined

    bool runFrame(const FrameDescription& frame)
    {
        bool holds = true;
        for (const Pass& pass : frame.passes)
            holds = runPass(pass) && holds;
        holds = matches(memory_, {FrameResource::color, 0}) && holds;
        if (frame.configuration.keeps_visibility)
            holds = matches(memory_, {FrameResource::visibility, 0}) && holds;
        if (frame.configuration.keeps_depth)
            holds = matches(memory_, {FrameResource::depth, 0}) && holds;
        return holds;
    }

    bool runPass(const Pass& pass)
    {
        map_ = pass.map;
        Contents tile;
        for (const AttachmentUse& use : pass.attachments)
        {
            const Name name = findName(use.resource);
            if (use.load == LoadOperation::load && memory_.contains(name))
                tile[name] = memory_[name];
            if (use.load == LoadOperation::clear)
                write(tile, name);
        }
        bool holds = true;
        for (const Subpass& subpass : pass.subpasses)
            for (const ResourceUse& use : subpass.attachments)
                if (!subpass.is_empty)
                    holds = runUse(use, tile) && holds;
        for (const ResourceUse& use : pass.uses)
            holds = runUse(use, memory_) && holds;
        for (const AttachmentUse& use : pass.attachments)
        {
            const Name name = findName(use.resource);
            memory_.erase(name);
            if (use.store && tile.contains(name))
                memory_[name] = tile[name];
        }
        return holds;
    }

    bool runUse(const ResourceUse& use, Contents& contents)
    {
        const bool attached = use.access == Access::color_write || use.access == Access::depth_write;
        const bool reads = use.access == Access::input || use.access == Access::depth_input ||
                           use.access == Access::sampled || use.access == Access::vertex_read ||
                           use.access == Access::fragment_read || use.access == Access::compute_read ||
                           (attached && use.content != Content::overwrite);
        const Name name = findName(use.resource);
        bool holds = true;
        if (reads && use.resource == FrameResource::shadow_map && !map_)
            holds = matchesAllMaps(contents); // shading
        else if (reads)                       // what frames before leave: pyramid, points
            holds = (!latest_.contains(name) && !attached) || matches(contents, name);
        if (attached || use.access == Access::compute_write || use.access == Access::copy_write)
            write(contents, name);
        return holds;
    }

    Name findName(FrameResource resource) const
    {
        return {resource, resource == FrameResource::shadow_map ? map_.value_or(0) : 0};
    }

    void write(Contents& contents, Name name) { contents[name] = ++latest_[name]; }

    bool matches(const Contents& contents, Name name) const
    {
        const auto have = contents.find(name);
        const auto want = latest_.find(name);
        return have != contents.end() && want != latest_.end() && have->second == want->second;
    }

    /// The maps that the frame draws; the others are cached.
    bool matchesAllMaps(const Contents& contents) const
    {
        return std::all_of(latest_.begin(), latest_.end(),
                           [&](const auto& latest) {
                               return latest.first.first != FrameResource::shadow_map ||
                                      matches(contents, latest.first);
                           });
    }

    Contents memory_, latest_;
    std::optional<uint32_t> map_; ///< of the pass
};

size_t countFindings(const FrameDescription& frame, LintRule rule)
{
    const std::vector<LintFinding> findings = lint(frame);
    return static_cast<size_t>(std::count_if(findings.begin(), findings.end(),
                                             [&](const LintFinding& f) { return f.rule == rule; }));
}

/// A warning that is allowed, and why.
struct AllowedWarning
{
    LintRule rule;
    std::string pass;
    std::string text; ///< part of it
    const char* reason;
    bool may_be_error = false;
};

const std::string kOnTile = "visibility + shading + add lights + final";
const std::string kSplitOnTile = "shading + add lights + final";
const std::string kSums = "visibility + normals + add lights + shading";
const std::string kSplitSums = "normals + add lights + shading";
const std::string kMarks = "visibility + mark lights + shading";
const std::string kSplitMarks = "mark lights + shading";

const AllowedWarning kAllowed[] = {
    {LintRule::spill, "visibility", "left the tile",
     "two phases: the pyramid of the early depth lies between"},
    {LintRule::spill, "visibility + shading", "left the tile", "as above"},
    {LintRule::spill, "moving shadow map", "left the tile", "casters at rest are copied from another layer"},
    {LintRule::spill, "shading", "loads the visibility",
     "compute passes cannot run within a render pass: tiles, gathered light, parts; or a pyramid of the "
     "depth "
     "that material numbers overwrite"},
    {LintRule::spill, "shading", "samples the visibility", "separate passes, which the device needs"},
    {LintRule::bubble, "early pyramid", "depth", "two phases: the late one culls against this frame's depth"},
    {LintRule::bubble, "pyramid", "depth", "the next frame culls against it; nothing of this frame waits"},
    {LintRule::bubble, "last pyramid", "depth",
     "as above; the last frame's fragments, and the culling of this one lies in front"},
    {LintRule::bubble, "visible lights", "visibility", "lights are listed for what pixels show"},
    {LintRule::bubble, "material tiles", "visibility",
     "many materials: a tile is drawn for those that it has"},
    {LintRule::bubble, "gather light", "visibility", "light is gathered where surfaces are visible"},
    {LintRule::spill, "exposure", "left the tile", "the last frame's light and exposure"},
    {LintRule::spill, "bloom down", "left the tile", "filters read neighbours"},
    {LintRule::spill, "bloom up", "left the tile", "as above"},
    {LintRule::spill, "final", "left the tile", "bloom reads neighbours, an output of another size too"},
    {LintRule::late_depth, "shading", "writes the depth", "material numbers as depth"},
    {LintRule::late_depth, "visibility + shading", "writes the depth", "material numbers as depth"},
    {LintRule::late_depth, "shading", "discards", "pixels of other materials, behind the stencil"},
    {LintRule::late_depth, "visibility + shading", "discards", "as above"},
    {LintRule::late_depth, kOnTile, "discards", "as above"},
    {LintRule::late_depth, kSplitOnTile, "discards", "as above"},
    {LintRule::tile_storage, kOnTile, "256 bits", "surfaces, light and the finished image of later tilers"},
    {LintRule::tile_storage, kSplitOnTile, "256 bits", "as above"},
    {LintRule::spill, kOnTile, "left the tile", "two phases: the pyramid of the early depth lies between"},
    {LintRule::spill, kSplitOnTile, "left the tile", "compute passes lie behind the visibility buffer"},
    {LintRule::tile_storage, "early visibility", "256 bits", "shares pipelines with the pass on the tile"},
    {LintRule::tile_storage, "visibility", "256 bits", "as above"},
    {LintRule::tile_storage, "visibility", "bits", "shares pipelines with the pass that stores surfaces"},
    {LintRule::tile_storage, "visibility + shading", "bits", "surfaces and the light that follows"},
    {LintRule::tile_storage, "shading", "bits", "as above"},
    {LintRule::tile_storage, "early visibility", "bits", "as above"},
    {LintRule::tile_storage, "add lights", "bits", "as above"},
    {LintRule::spill, "shading", "loads the depth", "passes that light surfaces behind it need it"},
    {LintRule::spill, "add lights", "left the tile", "stored surfaces"},
    {LintRule::tile_storage, kSums, "bits", "surfaces and sums at once: the pre-pass is there to compare",
     true},
    {LintRule::tile_storage, kSplitSums, "bits", "as above", true},
    {LintRule::tile_storage, kSums, "bits", "as above, with one image of sums"},
    {LintRule::tile_storage, kSplitSums, "bits", "as above"},
    {LintRule::tile_storage, "early visibility", "bits", "shares pipelines with the pre-pass", true},
    {LintRule::tile_storage, "visibility", "bits", "as above", true},
    {LintRule::tile_storage, kMarks, "160 bits", "bits of lights and linear colours"},
    {LintRule::tile_storage, kSplitMarks, "160 bits", "as above"},
    {LintRule::late_depth, kSums, "discards", "pixels of other materials, behind the stencil"},
    {LintRule::late_depth, kSplitSums, "discards", "as above"},
    {LintRule::late_depth, kMarks, "discards", "as above"},
    {LintRule::late_depth, kSplitMarks, "discards", "as above"},
    {LintRule::late_depth, "normals", "discards", "as above"},
    {LintRule::spill, kSums, "left the tile", "two phases: the pyramid of the early depth lies between"},
    {LintRule::spill, kMarks, "left the tile", "as above"},
    {LintRule::spill, kSplitSums, "left the tile", "compute passes lie behind the visibility buffer"},
    {LintRule::spill, kSplitMarks, "left the tile", "as above"},
    {LintRule::spill, "mark lights", "left the tile", "separate passes, which the device needs"},
    {LintRule::spill, "normals", "left the tile", "as above"},
    {LintRule::spill, "shading", "light", "as above: sums of light, or bits of lights"},
};

} // namespace

TEST(FramePasses, everyReadFindsWhatWasWrittenLast)
{
    Simulation simulation;
    for (const FrameConfiguration& c : sampleConfigurations())
        EXPECT_TRUE(simulation.run(describeFrame(c))) << nameConfiguration(c);
}

TEST(FramePasses, everyLoadAndStoreIsNeeded)
{
    Simulation simulation;
    size_t loads = 0, stores = 0;
    for (const FrameConfiguration& c : sampleConfigurations())
    {
        const FrameDescription frame = describeFrame(c);
        for (size_t p = 0; p < frame.passes.size(); ++p)
            for (size_t a = 0; a < frame.passes[p].attachments.size(); ++a)
            {
                FrameDescription changed = frame;
                AttachmentUse& use = changed.passes[p].attachments[a];
                if (use.load == LoadOperation::load)
                {
                    use.load = LoadOperation::none;
                    EXPECT_FALSE(simulation.run(changed)) << nameConfiguration(c);
                    use.load = LoadOperation::load;
                    ++loads;
                }
                if (use.store)
                {
                    use.store = false;
                    EXPECT_FALSE(simulation.run(changed)) << nameConfiguration(c);
                    ++stores;
                }
            }
    }
    EXPECT_GT(loads, 100u);
    EXPECT_GT(stores, 500u);
}

TEST(FramePasses, writesWaitForWhatIsReadBefore)
{
    // the early depth is sampled by the pyramid, and drawn to by the late phase
    const FrameDescription frame = describeFrame({});
    const Pass* pyramid = findPass(frame, FrameStep::early_pyramid);
    const Pass* late = findPass(frame, FrameStep::visibility);
    ASSERT_TRUE(pyramid != nullptr && late != nullptr);
    EXPECT_NE(pyramid->barrier.from & VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT, 0u);
    EXPECT_NE(pyramid->barrier.written & VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, 0u);
    EXPECT_NE(late->fragment_barrier.from & VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0u);
    EXPECT_NE(late->fragment_barrier.to & VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT, 0u);
    // the early draws read the list that the late phase adds to
    const Pass* late_cull = findPass(frame, FrameStep::late_cull);
    EXPECT_NE(late_cull->barrier.from & VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, 0u);
    EXPECT_NE(late_cull->barrier.from & VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0u);
}

TEST(FramePasses, theNextFramesGeometryDoesNotWaitForShading)
{
    constexpr VkPipelineStageFlags kGeometry = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT |
                                               VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT |
                                               VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;
    for (const FrameConfiguration& c : sampleConfigurations())
    {
        const FrameDescription frame = describeFrame(c);
        for (const Pass& pass : frame.passes)
        {
            const FrameStep step = pass.steps.front();
            if (step == FrameStep::last_pyramid)
            {
                // nothing but fragments waits for it
                const Pass& draws = *findPass(frame, FrameStep::visibility);
                EXPECT_EQ(draws.barrier.from, 0u);
                EXPECT_NE(findPass(frame, FrameStep::cull)->vertex_barrier.to &
                              VK_PIPELINE_STAGE_VERTEX_SHADER_BIT,
                          0u);
                continue;
            }
            if (step == FrameStep::early_pyramid || step == FrameStep::pyramid ||
                step == FrameStep::visible_lights || step == FrameStep::material_tiles ||
                step == FrameStep::gather)
                break; // waits for this frame's own fragments
            if (pass.kind != PassKind::transfer)
            {
                EXPECT_EQ(pass.barrier.from & ~kGeometry, 0u) << passName(pass);
                EXPECT_EQ(pass.vertex_barrier.from & ~kGeometry, 0u) << passName(pass);
            }
        }
    }
}

TEST(FramePasses, theFrontOfAFrameWaitsForWhatEarlierFramesShare)
{
    FrameConfiguration c{.lights_bricks = true};
    addMapsOfAllKinds(c);
    const FrameDescription frame = describeFrame(c);
    for (const FrameStep step :
         {FrameStep::update, FrameStep::brick_light, FrameStep::shadow_cull, FrameStep::cull})
    {
        const PassBarrier& wait = findPass(frame, step)->barrier;
        EXPECT_EQ(wait.from, VkPipelineStageFlags{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT}) << stepName(step);
        EXPECT_EQ(wait.to, VkPipelineStageFlags{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT}) << stepName(step);
        EXPECT_NE(wait.written & VK_ACCESS_SHADER_WRITE_BIT, 0u) << stepName(step);
    }
    // the last frame may sample the layer that a map is drawn into
    const PassBarrier& map = findPass(frame, FrameStep::shadow_map)->fragment_barrier;
    EXPECT_NE(map.from & VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0u);
    EXPECT_NE(map.to & VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT, 0u);
    EXPECT_NE(findPass(frame, FrameStep::shadow_copy)->barrier.from & VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
              0u);
}

TEST(FramePasses, shadowMapsAreListedOneByOne)
{
    constexpr uint32_t kMaps = 20, kAtOnce = 8;
    FrameConfiguration c{.has_shadows = true, .maps_at_once = kAtOnce};
    const double without = measureTraffic(describeFrame(c)).low;
    for (uint32_t map = 0; map < kMaps; ++map)
        c.maps.push_back(map % 5 == 4 ? MapContent::moving : MapContent::fresh);
    const FrameDescription frame = describeFrame(c);
    std::map<FrameStep, uint32_t> counts;
    for (const Pass& pass : frame.passes)
    {
        const FrameStep step = pass.steps.front();
        ++counts[step];
        if (step == FrameStep::shadow_map)
        {
            EXPECT_DOUBLE_EQ(measureTraffic(pass).low, 4);
        }
        if (step == FrameStep::shadow_copy || step == FrameStep::moving_shadow_map)
        {
            EXPECT_DOUBLE_EQ(measureTraffic(pass).low, 8);
        }
    }
    EXPECT_EQ(counts[FrameStep::shadow_map], 16u);
    EXPECT_EQ(counts[FrameStep::shadow_copy], 4u);
    EXPECT_EQ(counts[FrameStep::moving_shadow_map], 4u);
    EXPECT_EQ(counts[FrameStep::shadow_cull], 3u);
    EXPECT_DOUBLE_EQ(measureTraffic(frame).low, without);
    for (const LintFinding& finding : lint(frame))
        EXPECT_FALSE(finding.is_error) << finding.pass << ": " << finding.text;
    EXPECT_TRUE(Simulation().run(frame));
}

TEST(FramePasses, furtherShadowMapsAreLikeThoseOfThePlan)
{
    const auto same = [](const PassBarrier& a, const PassBarrier& b)
    { return a.from == b.from && a.written == b.written && a.to == b.to && a.accessed == b.accessed; };
    std::mt19937 random(1);
    for (int repetition = 0; repetition < 50; ++repetition)
    {
        FrameConfiguration c{.lights_bricks = true};
        addMapsOfAllKinds(c);
        const FrameDescription plan = describeFrame(c);
        c.maps.assign(random() % 20, MapContent::fresh);
        for (MapContent& map : c.maps)
            map = random() % 3 == 0 ? MapContent::moving : MapContent::fresh;
        c.maps_at_once = 1 + static_cast<uint32_t>(random() % 8);
        size_t rounds = 0;
        for (const Pass& pass : describeFrame(c).passes)
        {
            std::vector<const Pass*> planned;
            for (const Pass& p : plan.passes)
                if (p.steps == pass.steps)
                    planned.push_back(&p);
            // rounds after the first wait for the draws before
            const bool is_first = pass.steps.front() == FrameStep::shadow_cull && rounds++ == 0;
            const Pass& like = is_first ? *planned.front() : *planned.back();
            EXPECT_TRUE(same(pass.barrier, like.barrier)) << passName(pass);
            EXPECT_TRUE(same(pass.fragment_barrier, like.fragment_barrier)) << passName(pass);
            EXPECT_TRUE(same(pass.vertex_barrier, like.vertex_barrier)) << passName(pass);
            ASSERT_EQ(pass.attachments.size(), like.attachments.size());
            for (size_t i = 0; i < pass.attachments.size(); ++i)
            {
                EXPECT_EQ(pass.attachments[i].load, like.attachments[i].load);
                EXPECT_EQ(pass.attachments[i].store, like.attachments[i].store);
                EXPECT_EQ(pass.attachments[i].initial_layout, like.attachments[i].initial_layout);
                EXPECT_EQ(pass.attachments[i].final_layout, like.attachments[i].final_layout);
            }
        }
    }
}

TEST(FramePasses, haveFewBytesAPixel)
{
    struct Limit
    {
        OcclusionCulling occlusion;
        MaterialTest materials;
        double low, high;
    };
    // the aims of the frame on a phone; 29 in one column when each pass was written by hand
    constexpr Limit kLimits[] = {{OcclusionCulling::two_phase, MaterialTest::depth, 26, 34},
                                 {OcclusionCulling::two_phase, MaterialTest::id, 26, 34},
                                 {OcclusionCulling::last_frame, MaterialTest::id, 14, 22},
                                 {OcclusionCulling::off, MaterialTest::depth, 8, 12},
                                 {OcclusionCulling::off, MaterialTest::id, 8, 12}};
    for (const Limit& limit : kLimits)
    {
        const FrameConfiguration plain{.occlusion = limit.occlusion, .materials = limit.materials};
        const Traffic base = measureTraffic(describeFrame(plain));
        EXPECT_LE(base.low, limit.low);
        EXPECT_LE(base.high, limit.high);
        FrameConfiguration tiled = plain, gathering = plain, both = plain;
        tiled.material_tiles = both.material_tiles = true;
        gathering.gathers_light = both.gathers_light = true;
        const Traffic tiles = measureTraffic(describeFrame(tiled));
        const Traffic gather = measureTraffic(describeFrame(gathering));
        const Traffic all = measureTraffic(describeFrame(both));
        EXPECT_LE(tiles.low, base.low + 12);
        EXPECT_LE(tiles.high, base.high + 12);
        EXPECT_LE(gather.low, base.low + 10);
        EXPECT_LE(gather.high, base.high + 10);
        EXPECT_LE(all.low, base.low + 22);
        EXPECT_LE(all.high, base.high + 22);
        // lists of lights: nothing, or the visibility buffer three times, stored and read twice
        FrameConfiguration slots = plain, pixels = plain;
        slots.lists_lights = slots.lists_slots = true;
        pixels.lists_lights = pixels.lists_visible = true;
        EXPECT_DOUBLE_EQ(measureTraffic(describeFrame(slots)).low, base.low);
        EXPECT_DOUBLE_EQ(measureTraffic(describeFrame(slots)).high, base.high);
        EXPECT_LE(measureTraffic(describeFrame(pixels)).low, base.low + 12);
        EXPECT_LE(measureTraffic(describeFrame(pixels)).high, base.high + 12);
    }
}

/// A frame that lists lights for visible pixels is recorded by the plan of frames in parts.
TEST(FramePasses, listsOfWhatPixelsShowTakeThePlansOfParts)
{
    for (const FrameWay way : kFrameWays)
        for (FrameConfiguration c : allConfigurations(way, MaterialTest::depth, FrameFeatures::finished))
        {
            if (c.in_parts)
                continue;
            FrameConfiguration planned = c;
            planned.in_parts = true;
            addLightLists(planned);
            c.lists_lights = c.lists_visible = true;
            ASSERT_EQ(configurationIndex(c), configurationIndex(planned));
            std::vector<Pass> passes = describeFrame(c).passes;
            std::vector<Pass> of_plan = describeFrame(planned).passes;
            std::erase_if(of_plan, [](const Pass& p) { return p.steps.front() == FrameStep::slot_lights; });
            ASSERT_EQ(passes.size(), of_plan.size()) << nameConfiguration(c);
            for (size_t i = 0; i < passes.size(); ++i)
            {
                EXPECT_EQ(passes[i].steps, of_plan[i].steps);
                ASSERT_EQ(passes[i].attachments.size(), of_plan[i].attachments.size());
                for (size_t a = 0; a < passes[i].attachments.size(); ++a)
                {
                    const AttachmentUse& use = passes[i].attachments[a];
                    const AttachmentUse& other = of_plan[i].attachments[a];
                    EXPECT_EQ(use.resource, other.resource);
                    EXPECT_EQ(use.load, other.load);
                    EXPECT_EQ(use.store, other.store);
                    EXPECT_EQ(use.initial_layout, other.initial_layout);
                    EXPECT_EQ(use.final_layout, other.final_layout);
                }
                EXPECT_EQ(passes[i].barrier.to & ~of_plan[i].barrier.to, 0u);
                EXPECT_EQ(passes[i].fragment_barrier.to & ~of_plan[i].fragment_barrier.to, 0u);
            }
        }
}

TEST(FramePasses, separateTakeTheBytesOfUnmergedSubpasses)
{
    for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
        for (FrameConfiguration c : allConfigurations(FrameWay::separate, materials))
        {
            const FrameDescription frame = describeFrame(c);
            const Traffic separate = measureTraffic(frame);
            c.way = FrameWay::merged;
            const FrameDescription merged_frame = describeFrame(c);
            // a subpass that reads the visibility buffer of an earlier pass stores it again for the caller
            const bool is_split =
                findPass(merged_frame, FrameStep::visibility) != findPass(merged_frame, FrameStep::shading);
            const double stored_again = c.keeps_visibility && is_split ? 4 : 0;
            const Traffic merged = measureTraffic(merged_frame);
            EXPECT_DOUBLE_EQ(separate.low, separate.high) << nameConfiguration(c);
            EXPECT_DOUBLE_EQ(separate.high, merged.high - stored_again) << nameConfiguration(c);
            EXPECT_DOUBLE_EQ(separate.buffers, merged.buffers);
            for (const Pass& pass : frame.passes)
                EXPECT_EQ(pass.subpasses.size(), pass.kind == PassKind::render ? 1u : 0u);
        }
}

TEST(FramePasses, oneSetHasThePassesOfMergedSubpasses)
{
    for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
        for (FrameConfiguration c : allConfigurations(FrameWay::one_set, materials))
        {
            const FrameDescription one_set = describeFrame(c);
            c.way = FrameWay::merged;
            FrameDescription merged = describeFrame(c);
            merged.configuration.way = FrameWay::one_set;
            EXPECT_EQ(formatFrameJson(one_set), formatFrameJson(merged));
        }
}

TEST(FramePasses, partsLeaveTheSameImageStatesOnEveryWay)
{
    const auto layouts = [](const Pass& pass)
    {
        // before and after; of an image that the pass samples and hands out, too
        std::pair<VkImageLayout, VkImageLayout> found{};
        for (const AttachmentUse& use : pass.attachments)
            if (use.resource == FrameResource::visibility)
                found = {use.initial_layout, use.final_layout};
        for (const LayoutChange& change : pass.handed_out)
            found = {change.from, change.to};
        return found;
    };
    for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
    {
        FrameConfiguration c{.materials = materials, .in_parts = true, .keeps_visibility = true};
        const FrameDescription merged = describeFrame(c);
        c.way = FrameWay::separate;
        const FrameDescription separate = describeFrame(c);
        for (const FrameStep step : {FrameStep::visibility, FrameStep::shading})
        {
            const Pass *one = findPass(merged, step), *other = findPass(separate, step);
            EXPECT_EQ(layouts(*one), layouts(*other)) << stepName(step);
            EXPECT_NE(layouts(*one).second, VK_IMAGE_LAYOUT_UNDEFINED);
        }
        // shading waits for what the caller does between the parts
        const PassBarrier& wait = findPass(separate, FrameStep::shading)->fragment_barrier;
        EXPECT_EQ(wait.from & kCallerStages, kCallerStages);
        EXPECT_NE(wait.to & VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0u);
    }
}

TEST(FramePasses, storeTheBytesOfAShadowMapsDepths)
{
    for (const bool narrow : {false, true})
    {
        FrameConfiguration c{.shadow_format = narrow ? VK_FORMAT_D16_UNORM : VK_FORMAT_D32_SFLOAT};
        addMapsOfAllKinds(c);
        const FrameDescription frame = describeFrame(c);
        const double bytes = narrow ? 2 : 4;
        EXPECT_DOUBLE_EQ(measureTraffic(*findPass(frame, FrameStep::shadow_map)).low, bytes);
        EXPECT_DOUBLE_EQ(measureTraffic(*findPass(frame, FrameStep::shadow_copy)).low, 2 * bytes);
        EXPECT_DOUBLE_EQ(measureTraffic(frame).low, measureTraffic(describeFrame({})).low);
    }
}

TEST(FramePasses, finalPassesTakeFewBytes)
{
    const auto low = [](const FrameConfiguration& c) { return measureTraffic(describeFrame(c)).low; };
    const double in_tile = low({});
    FrameConfiguration c{.has_final_pass = true};
    EXPECT_DOUBLE_EQ(low(c), in_tile + 8) << "linear colours are stored and read";
    c.blooms = true;
    // down: each level of 4, 1, 1/4 ... bytes is read and the next written; up: a level and a sum are read
    double levels = 0, size = 4;
    for (int level = 1; level <= 5; ++level, size /= 4)
        levels += size + size / 4;
    for (int level = 1; level <= 4; ++level)
        levels += std::pow(0.25, level - 1) * (1 + 0.25 + 1);
    EXPECT_DOUBLE_EQ(low(c), in_tile + 8 + levels + 1);
    EXPECT_LE(low(c) - in_tile + 4, 22.7) << "with the store of the frame, 22.6 are estimated";
    c.adapts_exposure = true;
    const double last_level = 4 * std::pow(0.25, 5); // which automatic exposure reads once more
    EXPECT_DOUBLE_EQ(low(c), in_tile + 8 + levels + 1 + last_level);
    c.radiance_format = VK_FORMAT_R16G16B16A16_SFLOAT;
    EXPECT_DOUBLE_EQ(low(c), in_tile + 8 + levels + 1 + last_level + 8 + levels + 1 + last_level);
}

TEST(FramePasses, theImageTakesTheBytesOfItsFormat)
{
    FrameConfiguration c{.occlusion = OcclusionCulling::off};
    const double usual = measureTraffic(describeFrame(c)).low;
    c.color_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    EXPECT_DOUBLE_EQ(measureTraffic(describeFrame(c)).low, usual);
    c.color_format = VK_FORMAT_R16G16B16A16_SFLOAT;
    EXPECT_DOUBLE_EQ(measureTraffic(describeFrame(c)).low, usual + 4);
}

TEST(FramePasses, lightsBehindShadingTakeTheBytesOfSurfaces)
{
    FrameConfiguration c{.occlusion = OcclusionCulling::off, .materials = MaterialTest::id};
    const Traffic shaded = measureTraffic(describeFrame(c));
    c.has_final_pass = true;
    c.radiance_format = VK_FORMAT_R16G16B16A16_SFLOAT;
    c.light_path = LightPath::surfaces_on_tile;
    const Traffic on_tile = measureTraffic(describeFrame(c));
    EXPECT_DOUBLE_EQ(on_tile.low, shaded.low) << "nothing but the image leaves the tile";
    // depth, surfaces and radiance are stored and loaded, the radiance once more before the final pass
    EXPECT_DOUBLE_EQ(on_tile.high, shaded.high + 2 * (4 + 16 + 8) + 2 * 8);
    c.light_path = LightPath::surfaces;
    const Traffic stored = measureTraffic(describeFrame(c));
    EXPECT_DOUBLE_EQ(stored.low, shaded.low + 2 * (4 + 16 + 8) + 2 * 8);
    EXPECT_DOUBLE_EQ(stored.high, on_tile.high);
}

TEST(FramePasses, lightsAheadOfShadingStayOnTheTile)
{
    FrameConfiguration c{.occlusion = OcclusionCulling::off, .materials = MaterialTest::id};
    const Traffic shaded = measureTraffic(describeFrame(c));
    // unmerged, the depth is stored and loaded, and so are images between two subpasses; the normals are one
    // more reader of the visibility buffer
    constexpr double kDepth = 2 * 4, kVisibility = 4;
    constexpr std::pair<LightPath, double> kUnmerged[] = {
        {LightPath::light_bits, kDepth + 2 * 2 * 4},
        {LightPath::joint_sums, kDepth + 2 * 4 + kVisibility + 2 * 8},
        {LightPath::encoded_joint_sums, kDepth + 2 * 8 + kVisibility + 2 * 8},
        {LightPath::light_sums, kDepth + 2 * 8 + kVisibility + 2 * 3 * 8}};
    for (const auto& [path, bytes] : kUnmerged)
    {
        c.light_path = path;
        const FrameDescription frame = describeFrame(c);
        EXPECT_DOUBLE_EQ(measureTraffic(frame).low, shaded.low);
        EXPECT_DOUBLE_EQ(measureTraffic(frame).high, shaded.high + bytes);
        EXPECT_EQ(findPass(frame, FrameStep::visibility), findPass(frame, FrameStep::shading));
    }
}

TEST(FramePasses, onlyTheFinalPassStoresTheImage)
{
    for (const bool has_final_pass : {false, true})
    {
        const FrameDescription frame =
            describeFrame({.has_final_pass = has_final_pass, .adapts_exposure = has_final_pass});
        size_t stores = 0;
        for (const Pass& pass : frame.passes)
            for (const AttachmentUse& use : pass.attachments)
                stores += use.resource == FrameResource::color && use.store ? 1 : 0;
        EXPECT_EQ(stores, 1u);
        EXPECT_EQ(frame.passes.back().steps.back(),
                  has_final_pass ? FrameStep::final_pass : FrameStep::shading);
    }
}

TEST(FramePasses, automaticExposureWaitsForFragmentsAlone)
{
    const FrameDescription frame = describeFrame({.has_final_pass = true, .adapts_exposure = true});
    const Pass& exposure = *findPass(frame, FrameStep::exposure);
    EXPECT_EQ(exposure.barrier.from, 0u);
    constexpr VkPipelineStageFlags kFragments =
        VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    EXPECT_EQ(exposure.fragment_barrier.from & ~kFragments, 0u);
    EXPECT_NE(exposure.fragment_barrier.from & VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, 0u);
    const AttachmentUse& last = *std::find_if(
        frame.passes.end()[-2].attachments.begin(), frame.passes.end()[-2].attachments.end(),
        [](const AttachmentUse& use) { return use.resource == bloomLevel(shared::kBloomLevels); });
    EXPECT_STREQ(last.reader, kNextFrame);
}

TEST(FramePasses, sumToTheFrame)
{
    for (const FrameConfiguration& c : sampleConfigurations())
    {
        const FrameDescription frame = describeFrame(c);
        Traffic sum;
        for (const Pass& pass : frame.passes)
        {
            const Traffic traffic = measureTraffic(pass);
            EXPECT_LE(traffic.low, traffic.high);
            if (hasOwnSize(pass))
                continue;
            sum.low += traffic.low;
            sum.high += traffic.high;
        }
        EXPECT_DOUBLE_EQ(measureTraffic(frame).low, sum.low);
        EXPECT_DOUBLE_EQ(measureTraffic(frame).high, sum.high);
    }
}

TEST(FrameLint, findsNothingButWhatIsAllowed)
{
    std::set<const AllowedWarning*> seen;
    for (const FrameConfiguration& c : everyConfiguration())
        for (const LintFinding& finding : lint(describeFrame(c)))
        {
            const auto* allowed = std::find_if(std::begin(kAllowed), std::end(kAllowed),
                                               [&](const AllowedWarning& a)
                                               {
                                                   return a.rule == finding.rule && a.pass == finding.pass &&
                                                          a.may_be_error == finding.is_error &&
                                                          finding.text.find(a.text) != std::string::npos;
                                               });
            EXPECT_NE(allowed, std::end(kAllowed))
                << finding.pass << ": " << finding.text << nameConfiguration(c);
            seen.insert(allowed);
        }
    EXPECT_EQ(seen.size(), std::size(kAllowed)) << "an exception that nobody needs any more";
}

TEST(FrameLint, findsAPlantedErrorOfEachRule)
{
    const auto pass = [](FrameDescription& frame, FrameStep step) -> Pass&
    { return const_cast<Pass&>(*findPass(frame, step)); };
    const auto attachment = [](Pass& in, FrameResource resource) -> AttachmentUse&
    {
        return *std::find_if(in.attachments.begin(), in.attachments.end(),
                             [&](const AttachmentUse& use) { return use.resource == resource; });
    };
    struct Planted
    {
        LintRule rule;
        std::function<void(FrameDescription&)> plant;
    };
    const Planted planted[] = {
        {LintRule::undefined_load, [&](FrameDescription& f)
         { attachment(pass(f, FrameStep::visibility), FrameResource::color).load = LoadOperation::load; }},
        {LintRule::useless_store, [&](FrameDescription& f)
         { attachment(pass(f, FrameStep::visibility), FrameResource::depth).store = true; }},
        {LintRule::not_transient,
         [&](FrameDescription& f)
         {
             f = describeFrame({.occlusion = OcclusionCulling::off});
             f.transient.clear();
         }},
        {LintRule::unnamed_spill, [&](FrameDescription& f)
         { attachment(pass(f, FrameStep::early_visibility), FrameResource::depth).reader = nullptr; }},
        {LintRule::spill,
         [&](FrameDescription& f)
         {
             // of the stored visibility buffer, in a frame that needs none
             f = describeFrame({.occlusion = OcclusionCulling::off});
             Pass copy = pass(f, FrameStep::visibility);
             attachment(copy, FrameResource::visibility).store = true;
             f.passes.insert(f.passes.end() - 1, copy);
             attachment(f.passes.back(), FrameResource::visibility).load = LoadOperation::load;
         }},
        {LintRule::tile_storage,
         [&](FrameDescription& f)
         {
             Pass& p = pass(f, FrameStep::shading);
             for (int i = 0; i < 3; ++i)
                 p.attachments.push_back({.resource = FrameResource::color});
         }},
        {LintRule::attachment_count,
         [&](FrameDescription& f)
         {
             Pass& p = pass(f, FrameStep::shading);
             for (int i = 0; i < 5; ++i)
                 p.subpasses.back().attachments.push_back({FrameResource::color, Access::color_write});
         }},
        {LintRule::depth_changes,
         [&](FrameDescription& f)
         {
             std::erase_if(pass(f, FrameStep::shading).subpasses.back().attachments,
                           [](const ResourceUse& use) { return use.resource == FrameResource::depth; });
         }},
        {LintRule::not_by_region,
         [&](FrameDescription& f) { pass(f, FrameStep::shading).by_region = false; }},
        {LintRule::foreign_input,
         [&](FrameDescription& f)
         {
             pass(f, FrameStep::shading)
                 .subpasses.front()
                 .attachments.push_back({FrameResource::color, Access::input});
         }},
        {LintRule::clear_command, [&](FrameDescription& f)
         { pass(f, FrameStep::shading).subpasses.back().draws.clears_by_command = true; }},
        {LintRule::bubble,
         [&](FrameDescription& f) {
             pass(f, FrameStep::late_cull).uses.push_back({FrameResource::depth, Access::sampled});
         }},
        {LintRule::diagonal, [&](FrameDescription& f)
         { pass(f, FrameStep::shading).subpasses.back().draws.cover = Cover::quad; }},
        {LintRule::host_race,
         [&](FrameDescription& f) { pass(f, FrameStep::update).host_write = HostWrite::in_place; }},
        {LintRule::restored,
         [&](FrameDescription& f)
         {
             Pass copy = pass(f, FrameStep::shading);
             f.passes.push_back(copy);
         }},
        {LintRule::late_depth, [&](FrameDescription& f)
         { pass(f, FrameStep::visibility).subpasses.front().draws.discards = true; }},
    };
    EXPECT_EQ(std::size(planted), static_cast<size_t>(LintRule::count));
    for (const Planted& error : planted)
    {
        FrameDescription frame = describeFrame({});
        // spills and the rest are compared with the same frame, unharmed
        const size_t before = error.rule == LintRule::spill ? 0 : countFindings(frame, error.rule);
        error.plant(frame);
        EXPECT_GT(countFindings(frame, error.rule), before) << ruleName(error.rule);
    }
}

TEST(FrameLint, findsErrorsOfShadowMaps)
{
    FrameConfiguration c;
    addMapsOfAllKinds(c);
    FrameDescription uncopied = describeFrame(c);
    std::erase_if(uncopied.passes,
                  [](const Pass& pass) { return pass.steps.front() == FrameStep::shadow_copy; });
    for (Pass& pass : uncopied.passes)
        if (pass.steps.front() == FrameStep::shadow_map)
            pass.attachments.front().store = false;
    EXPECT_EQ(countFindings(uncopied, LintRule::undefined_load), 1u);
    FrameDescription unread = describeFrame(c);
    for (Pass& pass : unread.passes)
        std::erase_if(pass.uses, [&](const ResourceUse& use)
                      { return use.resource == FrameResource::shadow_map && !pass.map; });
    EXPECT_EQ(countFindings(unread, LintRule::useless_store), c.maps.size());
}

TEST(FrameWays, areChosenByWhatIsKnownOfADevice)
{
    constexpr uint32_t kApple = 0x106B, kArm = 0x13B5, kQualcomm = 0x5143;
    EXPECT_EQ(chooseFrameWay({kArm, "Mali-G52"}), FrameWay::one_set);
    EXPECT_EQ(chooseFrameWay({kArm, "Mali-G76 MC4"}), FrameWay::separate);
    EXPECT_EQ(chooseFrameWay({kArm, "Mali-G77"}), FrameWay::separate);
    EXPECT_EQ(chooseFrameWay({kArm, "Mali-G720-Immortalis MC12"}), FrameWay::merged)
        << "another than the G72";
    EXPECT_EQ(chooseFrameWay({kArm, "Mali-G78"}), FrameWay::merged);
    EXPECT_EQ(chooseFrameWay({kQualcomm, "Adreno (TM) 740"}), FrameWay::separate);
    EXPECT_EQ(chooseFrameWay({kQualcomm, "Turnip Adreno (TM) 740"}), FrameWay::merged) << "another driver";
    EXPECT_EQ(chooseFrameWay({kApple, "Apple M1"}), FrameWay::separate);
    EXPECT_EQ(chooseFrameWay({kQualcomm, "Mali-G52"}), FrameWay::merged) << "another maker";
    EXPECT_EQ(chooseFrameWay({}), FrameWay::merged);
}

TEST(FrameText, saysWhatCrossesTheBus)
{
    const FrameDescription frame =
        describeFrame({.has_shadows = true, .maps = {MapContent::fresh, MapContent::moving}});
    const std::string text = formatFrameText(frame), json = formatFrameJson(frame);
    EXPECT_NE(text.find("25.33   33.33"), std::string::npos) << text;
    EXPECT_NE(text.find("visibility + shading"), std::string::npos);
    for (const char* name : {"\nshadow map ", "\nshadow copy ", "\nmoving shadow map "})
        EXPECT_NE(text.find(name), std::string::npos) << text;
    EXPECT_NE(json.find("\"bytes_per_pixel\":{\"low\":25.33,\"high\":33.33}"), std::string::npos) << json;
    EXPECT_NE(json.find("\"warnings\":["), std::string::npos);
}

} // namespace hearth::test

// Tests the table of a frame: a simulation of tiles and memory judges what it loads and stores, the lint
// finds planted errors of each rule, and bytes a pixel stay within their limits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_lint.h"
#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/frame/frame_text.h"
#include "runtime/gpu/frame/frame_way.h"

#include <functional>
#include <gtest/gtest.h>
#include <map>
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
    for (const FrameWay way : kFrameWays)
        for (const MaterialTest materials : {MaterialTest::depth, MaterialTest::id})
            for (FrameConfiguration c : allConfigurations(way, materials))
                for (const bool rich : {false, true})
                {
                    c.has_shadows = c.lights_bricks = rich;
                    all.push_back(c);
                }
    return all;
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
    /// Return true if every read finds what was written last.
    bool run(const FrameDescription& frame)
    {
        memory_.clear();
        latest_.clear();
        bool holds = true;
        for (const Pass& pass : frame.passes)
            holds = runPass(pass) && holds;
        holds = matches(memory_, FrameResource::color) && holds;
        if (frame.configuration.keeps_visibility)
            holds = matches(memory_, FrameResource::visibility) && holds;
        return holds;
    }

private:
    using Contents = std::map<FrameResource, int>; // version; absent: undefined

    bool runPass(const Pass& pass)
    {
        Contents tile;
        for (const AttachmentUse& use : pass.attachments)
        {
            if (use.load == LoadOperation::load && memory_.contains(use.resource))
                tile[use.resource] = memory_[use.resource];
            if (use.load == LoadOperation::clear)
                write(tile, use.resource);
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
            memory_.erase(use.resource);
            if (use.store && tile.contains(use.resource))
                memory_[use.resource] = tile[use.resource];
        }
        return holds;
    }

    bool runUse(const ResourceUse& use, Contents& contents)
    {
        const bool attached = use.access == Access::color_write || use.access == Access::depth_write;
        const bool reads = use.access == Access::input || use.access == Access::sampled ||
                           use.access == Access::vertex_read || use.access == Access::fragment_read ||
                           (attached && use.content != Content::overwrite);
        // what frames before leave: pyramid, points; maps are cached
        const bool from_earlier_frame = !latest_.contains(use.resource);
        const bool holds = !reads || (from_earlier_frame && !attached) || matches(contents, use.resource);
        if (attached || use.access == Access::compute_write)
            write(contents, use.resource);
        return holds;
    }

    void write(Contents& contents, FrameResource resource) { contents[resource] = ++latest_[resource]; }

    bool matches(const Contents& contents, FrameResource resource) const
    {
        const auto have = contents.find(resource);
        const auto want = latest_.find(resource);
        return have != contents.end() && want != latest_.end() && have->second == want->second;
    }

    Contents memory_, latest_;
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
};

const AllowedWarning kAllowed[] = {
    {LintRule::spill, "visibility", "left the tile",
     "two phases: the pyramid of the early depth lies between"},
    {LintRule::spill, "visibility + shading", "left the tile", "as above"},
    {LintRule::spill, "shading", "loads the visibility",
     "compute passes cannot run within a render pass: tiles, gathered light, parts; or a pyramid of the "
     "depth "
     "that material numbers overwrite"},
    {LintRule::spill, "shading", "samples the visibility", "separate passes, which the device needs"},
    {LintRule::bubble, "early pyramid", "depth", "two phases: the late one culls against this frame's depth"},
    {LintRule::bubble, "pyramid", "depth", "the next frame culls against it; nothing of this frame waits"},
    {LintRule::bubble, "material tiles", "visibility",
     "many materials: a tile is drawn for those that it has"},
    {LintRule::bubble, "gather light", "visibility", "light is gathered where surfaces are visible"},
    {LintRule::late_depth, "shading", "writes the depth", "material numbers as depth"},
    {LintRule::late_depth, "visibility + shading", "writes the depth", "material numbers as depth"},
    {LintRule::late_depth, "shading", "discards", "pixels of other materials, behind the stencil"},
    {LintRule::late_depth, "visibility + shading", "discards", "as above"},
};

} // namespace

TEST(FramePasses, everyReadFindsWhatWasWrittenLast)
{
    Simulation simulation;
    for (const FrameConfiguration& c : everyConfiguration())
        EXPECT_TRUE(simulation.run(describeFrame(c))) << nameConfiguration(c);
}

TEST(FramePasses, everyLoadAndStoreIsNeeded)
{
    Simulation simulation;
    size_t loads = 0, stores = 0;
    for (const FrameConfiguration& c : everyConfiguration())
    {
        const FrameDescription frame = describeFrame(c);
        for (size_t p = 0; p < frame.passes.size(); ++p)
            for (size_t a = 0; a < frame.passes[p].attachments.size(); ++a)
            {
                FrameDescription changed = frame;
                AttachmentUse& use = changed.passes[p].attachments[a];
                if (use.resource == FrameResource::shadow_map)
                    continue; // cached over frames
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
    EXPECT_NE(late->barrier.from & VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0u);
    EXPECT_NE(late->barrier.to & VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT, 0u);
}

TEST(FramePasses, theNextFramesCullingDoesNotWaitForShading)
{
    for (const FrameConfiguration& c : everyConfiguration())
        for (const FrameStep step : {FrameStep::cull, FrameStep::late_cull})
            if (const Pass* pass = findPass(describeFrame(c), step))
            {
                EXPECT_EQ(pass->barrier.from & ~VkPipelineStageFlags{VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT},
                          0u);
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
        const PassBarrier& wait = findPass(separate, FrameStep::shading)->barrier;
        EXPECT_EQ(wait.from & kCallerStages, kCallerStages);
        EXPECT_NE(wait.to & VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0u);
    }
}

TEST(FramePasses, storeTheBytesOfAShadowMapsDepths)
{
    for (const float bytes : {2.0f, 4.0f})
    {
        const FrameDescription frame = describeFrame({.has_shadows = true, .shadow_bytes = bytes});
        EXPECT_DOUBLE_EQ(measureTraffic(*findPass(frame, FrameStep::shadow_maps)).low, double{bytes});
        EXPECT_DOUBLE_EQ(measureTraffic(frame).low, measureTraffic(describeFrame({})).low);
    }
}

TEST(FramePasses, sumToTheFrame)
{
    for (const FrameConfiguration& c : everyConfiguration())
    {
        const FrameDescription frame = describeFrame(c);
        Traffic sum;
        for (const Pass& pass : frame.passes)
        {
            const Traffic traffic = measureTraffic(pass);
            EXPECT_LE(traffic.low, traffic.high);
            if (pass.steps.front() == FrameStep::shadow_maps)
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
                                                          finding.text.find(a.text) != std::string::npos;
                                               });
            EXPECT_FALSE(finding.is_error) << finding.pass << ": " << finding.text << nameConfiguration(c);
            EXPECT_NE(allowed, std::end(kAllowed)) << finding.pass << ": " << finding.text;
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

TEST(FrameWays, areChosenByWhatIsKnownOfADevice)
{
    constexpr uint32_t kApple = 0x106B, kArm = 0x13B5, kQualcomm = 0x5143;
    EXPECT_EQ(chooseFrameWay({kArm, "Mali-G52"}), FrameWay::separate);
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
    const FrameDescription frame = describeFrame({.has_shadows = true});
    const std::string text = formatFrameText(frame), json = formatFrameJson(frame);
    EXPECT_NE(text.find("25.33   33.33"), std::string::npos) << text;
    EXPECT_NE(text.find("visibility + shading"), std::string::npos);
    EXPECT_NE(json.find("\"bytes_per_pixel\":{\"low\":25.33,\"high\":33.33}"), std::string::npos) << json;
    EXPECT_NE(json.find("\"warnings\":["), std::string::npos);
}

} // namespace hearth::test

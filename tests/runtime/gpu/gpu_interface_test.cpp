// Tests that shaders and C++ agree about everything that crosses between them: reflects every shader of the
// renderer and compares it with the layouts, push constants, specialization constants and structs of C++.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/pick_pass.h"
#include "runtime/gpu/receivers/receiver_pass.h"
#include "runtime/gpu/statistics/cull_statistics_pass.h"
#include "runtime/gpu/statistics/light_statistics_pass.h"
#include "runtime/gpu/temporal/motion_pass.h"
#include "runtime/gpu/temporal/temporal_pass.h"
#include "runtime/gpu/vulkan/specialized_shader.h"
#include "runtime/viewer/vulkan_host.h"
#include "tests/runtime/gpu/brick_scene.h"
#include "tests/runtime/gpu/deformed_scene.h"
#include "tests/runtime/gpu/interface_check.h"
#include "tests/runtime/scene_proxies.h"
#include "tests/runtime/shaders/shader_list.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>

namespace hearth::test
{

namespace
{

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<uint32_t> readWords(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    EXPECT_FALSE(bytes.empty()) << path;
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
    return words;
}

/// The specialization constants by their names in GLSL.
std::map<std::string, uint32_t> constantIds()
{
    return {{"kUsedSlices", shared::kConstantUsedSlices},
            {"kTextures", shared::kConstantTextures},
            {"kUvSets", shared::kConstantUvSets},
            {"kUnlit", shared::kConstantUnlit},
            {"kDeformed", shared::kConstantDeformed},
            {"kSkyVisibility", shared::kConstantSkyVisibility},
            {"kLayers", shared::kConstantLayers},
            {"kComparesMaterial", shared::kConstantComparesMaterial},
            {"kFiltersShadows", shared::kConstantFiltersShadows},
            {"kLightList", shared::kConstantLightList},
            {"kStored", shared::kConstantStored},
            {"kReflects", shared::kConstantReflects},
            {"kReceivers", shared::kConstantReceivers},
            {"kLocalProbes", shared::kConstantLocalProbes},
            {"kMaterialFunction", shared::kConstantMaterialFunction},
            {"kEncodes", shared::kConstantEncodes},
            {"kMaterialMotion", shared::kConstantMaterialMotion}};
}

/// Not a GpuTest: that creates pipelines, and a driver may crash where a shader and a layout differ.
class GpuInterfaceTest : public testing::Test
{
protected:
    /// Record all pipelines that the renderer can create. Nothing is drawn.
    void SetUp() override
    {
        if (!both_.pipelines.empty())
            return;
        auto host = viewer::VulkanHost::create({.device_name = "", .validate = false});
        ASSERT_TRUE(host.ok()) << formatMessage(host.error());
        host_ = std::move(*host);
        const gpu::DeviceDescription recording = recordPipelines(host_->description());
        for (const gpu::FrameWay way : gpu::kFrameWays)
        {
            auto created = gpu::Renderer::create(recording, {.way = way, .post = gpu::PostSupport::packed});
            ASSERT_TRUE(created.ok());
            uploadAll(**created);
            ASSERT_TRUE((*created)->prepareOverdraw().ok());
            // finds materials by id as well
            auto deferred = gpu::Renderer::create(recording, {.way = way, .deferred = true});
            ASSERT_TRUE(deferred.ok());
            uploadAll(**deferred);
        }
        const auto device = gpu::makeDevice(recording);
        ASSERT_TRUE(device.ok());
        auto receivers = gpu::ReceiverPass::create(*device, gpu::ReceiverUpdate::compute);
        EXPECT_TRUE(receivers.ok() && receivers->prepareFaces(*device).ok());
        EXPECT_TRUE(gpu::ReceiverPass::create(*device, gpu::ReceiverUpdate::points).ok());
        both_ = {{}, recordedPipelines(), sharedStructs(), constantIds()};
        for (const ListedShader& shader : listedShaders())
        {
            const std::vector<uint32_t> named = readWords(shader.named_file);
            both_.shaders.push_back(
                {shader.name, {shader.words.begin(), shader.words.end()}, reflectShader(named)});
            const std::vector<uint32_t> moved = gpu::moveToOneSet(shader.words);
            if (moved != both_.shaders.back().words && isRecorded(moved))
                both_.shaders.push_back({std::string(shader.name) + " of one set", moved,
                                         reflectShader(gpu::moveToOneSet(named))});
        }
    }

    void uploadAll(gpu::Renderer& recorded)
    {
        uploadRocks(recorded);
        uploadDeformed(recorded);
        uploadBricks(recorded, {});
        uploadBricks(recorded, {.max_maps = 4});
    }

    std::unique_ptr<gpu::Scene> uploadWith(gpu::Renderer& recorded, const formats::PackView& pack,
                                           const gpu::SceneOptions& options)
    {
        std::unique_ptr<gpu::Scene> scene;
        const Status status = host_->run(
            [&](VkCommandBuffer commands) -> Status
            {
                HEARTH_ASSIGN_OR_RETURN(scene, recorded.upload(pack, commands, options));
                return success();
            });
        HEARTH_ASSERT(status.ok());
        scene->staging.reset();
        return scene;
    }

    void uploadRocks(gpu::Renderer& recorded)
    {
        TestScene test;
        test.addInstance(test.addMesh(withMaterial(shapes::rock(10, 0.2f), kInvalidIndex)), Affine3{});
        addProxy(test.model(), 0, shapes::rock(4, 0), 0.2f, true);
        const formats::PackView pack = test.build();
        const auto scene =
            uploadWith(recorded, pack, {.shadows = {.max_maps = 4, .casters = gpu::Casters::proxies}});
        prepareLights(recorded, *scene);
    }

    static void prepareLights(gpu::Renderer& recorded, gpu::Scene& scene)
    {
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
            if (recorded.supports(static_cast<gpu::LightMethod>(method)))
                EXPECT_TRUE(recorded.prepareLightMethod(scene, static_cast<gpu::LightMethod>(method)).ok());
    }

    void uploadDeformed(gpu::Renderer& recorded)
    {
        const DeformedScene deformed({.rings = 8}, 1);
        const auto scene =
            uploadWith(recorded, deformed.pack(), {.shadows = {.max_maps = 4}, .keeps_motion = true});
        prepareLights(recorded, *scene);
        EXPECT_TRUE(gpu::CullStatisticsPass::create(recorded.device(), *scene).ok());
        EXPECT_TRUE(gpu::PickPass::create(recorded.device(), recorded.layouts(), *scene).ok());
        EXPECT_TRUE(gpu::TemporalPass::create(recorded.device(), recorded.layouts()).ok());
        EXPECT_TRUE(gpu::MotionPass::create(recorded.device(), recorded.layouts(), *scene).ok());
        const auto targets = recorded.createTargets({16, 16}, {.keeps_visibility = true});
        ASSERT_TRUE(targets.ok());
        EXPECT_TRUE(
            gpu::LightStatisticsPass::create(recorded.device(), recorded.layouts(), *scene, *targets).ok());
    }

    void uploadBricks(gpu::Renderer& recorded, const gpu::ShadowOptions& shadows)
    {
        TestScene test;
        test.addInstance(test.addMesh(withMaterial(makeQuad(1, 1), kInvalidIndex)), Affine3{});
        setBricks(test, brickModel({8, 8, 8}, makeShell({8, 8, 8}),
                                   [](std::array<uint32_t, 3>, uint32_t) { return FaceLook{}; }));
        const formats::PackView pack = test.build();
        prepareLights(recorded, *uploadWith(recorded, pack, {.shadows = shadows}));
    }

    static bool isRecorded(const std::vector<uint32_t>& words)
    {
        return std::any_of(recordedPipelines().begin(), recordedPipelines().end(),
                           [&](const RecordedPipeline& pipeline)
                           {
                               return std::any_of(pipeline.stages.begin(), pipeline.stages.end(),
                                                  [&](const RecordedStage& s) { return s.words == words; });
                           });
    }

    /// The first recorded pipeline that has this shader.
    static RecordedPipeline& findPipeline(GpuInterface& sides, const std::string& shader)
    {
        for (const InterfaceShader& listed : sides.shaders)
            for (RecordedPipeline& pipeline : sides.pipelines)
                for (const RecordedStage& stage : pipeline.stages)
                    if (listed.name == shader && stage.words == listed.words)
                        return pipeline;
        HEARTH_ASSERT(false);
        return sides.pipelines.front();
    }

    std::unique_ptr<viewer::VulkanHost> host_;
    static GpuInterface both_;
};

GpuInterface GpuInterfaceTest::both_;

constexpr VkShaderStageFlags kAnyStage = ~VkShaderStageFlags{0};

/// Count the descriptors of a pipeline in a stage, or in all, by the names of the limits.
template <typename Use>
void countDescriptors(const RecordedPipeline& pipeline, VkShaderStageFlags stage, const Use& use)
{
    uint64_t storages = 0, uniforms = 0, textures = 0, images = 0, inputs = 0;
    for (const RecordedSet& set : pipeline.sets)
        for (const VkDescriptorSetLayoutBinding& binding : set)
            if ((binding.stageFlags & stage) != 0)
                (binding.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER           ? storages
                 : binding.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER         ? uniforms
                 : binding.descriptorType == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER ? textures
                 : binding.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE          ? images
                                                                                       : inputs) +=
                    binding.descriptorCount;
    if (stage == kAnyStage)
    {
        use("maxDescriptorSetStorageBuffers", storages);
        use("maxDescriptorSetUniformBuffers", uniforms);
        use("maxDescriptorSetSamplers", textures);
        use("maxDescriptorSetSampledImages", textures);
        return;
    }
    use("maxPerStageDescriptorStorageBuffers", storages);
    use("maxPerStageDescriptorUniformBuffers", uniforms);
    use("maxPerStageDescriptorSamplers", textures);
    use("maxPerStageDescriptorSampledImages", textures);
    use("maxPerStageDescriptorStorageImages", images);
    use("maxPerStageDescriptorInputAttachments", inputs);
    const uint64_t colors = stage == VK_SHADER_STAGE_FRAGMENT_BIT ? 1 : 0;
    use("maxPerStageResources", storages + uniforms + textures + images + inputs + colors);
}

/// Return the uniform blocks of a shader: blocks are in the order of the buffers among the resources.
std::vector<ReflectedStruct> uniformBlocks(const ShaderReflection& reflection)
{
    std::vector<ReflectedStruct> uniforms;
    size_t block = 0;
    for (const ReflectedResource& resource : reflection.resources)
    {
        if (resource.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)
            uniforms.push_back(reflection.blocks.at(block));
        if (resource.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
            resource.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)
            ++block;
    }
    return uniforms;
}

} // namespace

TEST_F(GpuInterfaceTest, shadersAndCppAgree)
{
    for (const std::string& difference : findDifferences(both_))
        ADD_FAILURE() << difference;
    EXPECT_GT(both_.shaders.size(), 40u);
    EXPECT_GT(both_.pipelines.size(), both_.shaders.size());
}

TEST_F(GpuInterfaceTest, theRequiredLimitsAreThoseOfThePipelines)
{
    std::map<std::string, uint64_t> used;
    const auto use = [&](const std::string& name, uint64_t value)
    { used[name] = std::max(used[name], value); };
    for (const RecordedPipeline& pipeline : both_.pipelines)
    {
        use("maxBoundDescriptorSets", pipeline.sets.size());
        for (const VkPushConstantRange& range : pipeline.push)
            use("maxPushConstantsSize", range.offset + range.size);
        for (const VkShaderStageFlags stage : {VkShaderStageFlags{VK_SHADER_STAGE_VERTEX_BIT},
                                               VkShaderStageFlags{VK_SHADER_STAGE_FRAGMENT_BIT},
                                               VkShaderStageFlags{VK_SHADER_STAGE_COMPUTE_BIT}, kAnyStage})
            countDescriptors(pipeline, stage, use);
    }
    for (const InterfaceShader& shader : both_.shaders)
    {
        const std::array<uint32_t, 3>& size = shader.reflection.workgroup;
        use("maxComputeWorkGroupInvocations", uint64_t{size[0]} * size[1] * size[2]);
        use("maxComputeWorkGroupSize[0]", size[0]);
        use("maxComputeWorkGroupSize[1]", size[1]);
        use("maxComputeSharedMemorySize", shader.reflection.shared_bytes);
        EXPECT_LE(size[2], 1u);
        for (const ReflectedStruct& block : uniformBlocks(shader.reflection))
            use("maxUniformBufferRange", block.size);
    }
    use("maxStorageBufferRange", uint64_t{4} << shared::kPoolSliceAddressBits);
    for (const gpu::RequiredLimit& limit : gpu::requiredLimits())
        EXPECT_EQ(limit.needed, used[limit.name]) << limit.name;
    EXPECT_EQ(used.size(), gpu::requiredLimits().size());
}

TEST_F(GpuInterfaceTest, findsADescriptorOfAnotherTypeOrStage)
{
    GpuInterface changed = both_;
    RecordedSet& tables = findPipeline(changed, "cull_instances_comp").sets[shared::kSetTables];
    tables[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    tables[1].stageFlags = VK_SHADER_STAGE_VERTEX_BIT;
    EXPECT_THAT(findDifferences(changed),
                ElementsAre(AllOf(HasSubstr("cull_instances_comp: "), HasSubstr("uniform buffer"),
                                  HasSubstr("the layout has a storage buffer")),
                            AllOf(HasSubstr("cull_instances_comp: "),
                                  HasSubstr("the layout has it for other stages"))));
}

TEST_F(GpuInterfaceTest, findsABindingThatOneSideLacks)
{
    GpuInterface changed = both_;
    RecordedSet& tables = findPipeline(changed, "scan_totals_comp").sets[shared::kSetTables];
    tables[0].binding = 30;
    EXPECT_THAT(findDifferences(changed),
                ElementsAre(AllOf(HasSubstr("scan_totals_comp: "), HasSubstr("no such binding")),
                            HasSubstr("no shader uses binding 30 (storage buffer) of a set layout of 2 "
                                      "bindings: scan_totals_comp")));
}

TEST_F(GpuInterfaceTest, findsPushConstantsOfAnotherSize)
{
    GpuInterface changed = both_;
    findPipeline(changed, "pyramid_top_comp").push[0].size = 4;
    EXPECT_THAT(findDifferences(changed),
                ElementsAre("pyramid_top_comp: PyramidPush has 8 bytes, the layout 4 from byte 0"));
}

TEST_F(GpuInterfaceTest, findsAMemberInAnotherPlace)
{
    GpuInterface changed = both_;
    for (SharedStruct& known : changed.structs)
        if (known.name == "SkinningPlanPush")
            std::swap(known.members[0].offset, known.members[1].offset);
    EXPECT_THAT(findDifferences(changed),
                ElementsAre("plan_skinning_comp: struct SkinningPlanPush has uint bin_count at byte 0, C++ "
                            "uint bin_count at byte 4",
                            "plan_skinning_comp: struct SkinningPlanPush has uint first_bin at byte 4, C++ "
                            "uint first_bin at byte 0"));
}

TEST_F(GpuInterfaceTest, findsAnArrayWithAnotherStride)
{
    GpuInterface changed = both_;
    for (SharedStruct& known : changed.structs)
        if (known.name == "GroupItem")
            known.size += 4;
    EXPECT_THAT(
        findDifferences(changed),
        ElementsAre("page_requests_comp: an array of GroupItem in Items has 12 bytes for each, in C++ 16",
                    "page_requests_deformed_comp: an array of GroupItem in Items has 12 bytes for each, "
                    "in C++ 16"));
}

TEST_F(GpuInterfaceTest, findsAConstantWithAnotherIdOrWithoutValue)
{
    GpuInterface changed = both_;
    changed.constant_ids["kUnlit"] = 7;
    findPipeline(changed, "skin_vertices_comp").stages[0].constants.erase(shared::kConstantUsedSlices);
    const std::vector<std::string> found = findDifferences(changed);
    EXPECT_THAT(found, Contains("shading_frag: constant kUnlit (id 3) has id 7 in C++"));
    EXPECT_THAT(found,
                Contains("skin_vertices_comp: constant kUsedSlices (id 0): a pipeline gives it no value"));
}

TEST_F(GpuInterfaceTest, findsAShaderThatNoPipelineHas)
{
    GpuInterface changed = both_;
    const std::vector<uint32_t> words = findPipeline(changed, "gather_smooth_comp").stages[0].words;
    std::erase_if(changed.pipelines,
                  [&](const RecordedPipeline& pipeline) { return pipeline.stages[0].words == words; });
    EXPECT_THAT(findDifferences(changed), Contains("gather_smooth_comp: no pipeline has it"));
}

} // namespace hearth::test

// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"
#include "runtime/pack/pack.h"
#include "tests/support/small_pack.h"

#include <gtest/gtest.h>

#include <limits>

namespace hearth::test
{

using namespace formats;

namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// View of the model's bytes without any semantic check.
class Opened
{
public:
    explicit Opened(const PackModel& model)
        : bytes_(model.bytes()),
          view_(PackView::read(ContainerReader::fromBytes(bytes_.span(), "small.hearth").value()))
    {
    }
    const PackView* operator->() const { return &view_.value(); }
    const PackView& operator*() const { return view_.value(); }

private:
    AlignedBytes bytes_;
    Result<PackView> view_;
};

} // namespace

TEST(PackView, givesEveryTable)
{
    const PackModel model = smallPack();
    const Opened view(model);
    EXPECT_EQ(view->meta(), model.meta);
    EXPECT_EQ(view->strings(), model.strings);
    EXPECT_EQ(view->nodes().size(), model.nodes.size());
    EXPECT_EQ(view->instances().size(), model.instances.size());
    EXPECT_EQ(view->cameras().size(), model.cameras.size());
    EXPECT_EQ(view->lights().size(), model.lights.size());
    EXPECT_EQ(view->shadowSpheres().size(), model.shadow_spheres.size());
    EXPECT_EQ(view->materials().size(), model.materials.size());
    EXPECT_EQ(view->materialLayers().size(), model.material_layers.size());
    EXPECT_EQ(view->images().size(), model.images.size());
    EXPECT_EQ(view->skins().size(), model.skins.size());
    EXPECT_EQ(view->joints().size(), model.joints.size());
    EXPECT_EQ(view->animations().size(), model.animations.size());
    EXPECT_EQ(view->channels().size(), model.channels.size());
    EXPECT_TRUE(std::ranges::equal(view->keys(), model.keys));
    EXPECT_TRUE(std::ranges::equal(view->keyBits(), model.key_bits));
    EXPECT_TRUE(std::ranges::equal(view->morphWeights(), model.morph_weights));
    EXPECT_EQ(view->meshes().size(), model.meshes.size());
    EXPECT_EQ(view->levels().size(), model.levels.size());
    EXPECT_EQ(view->groups().size(), model.groups.size());
    EXPECT_EQ(view->clusters().size(), model.clusters.size());
    EXPECT_EQ(view->pages().size(), model.pages.size());
    EXPECT_TRUE(std::ranges::equal(view->pageParents(), model.page_parents));
}

TEST(PackView, givesNamesAndNothingForThoseOutside)
{
    const Opened view(smallPack());
    EXPECT_EQ(view->text(view->nodes()[1].name), "strip node");
    EXPECT_EQ(view->text({0xFFFFFFFF, 0xFFFFFFFF}), "");
    EXPECT_EQ(view->text({0, static_cast<uint32_t>(view->strings().size()) + 1}), "");
}

TEST(PackView, findsTheExtrasOfAnObject)
{
    const Opened view(smallPack());
    EXPECT_EQ(view->findExtras(ExtrasOwner::node, 1), R"({"speed":1.50,"tag":"T\u00fcr"})");
    EXPECT_EQ(view->findExtras(ExtrasOwner::mesh, 2), "[1,2]");
    EXPECT_EQ(view->findExtras(ExtrasOwner::file, 0), "12345678901234567890");
    EXPECT_EQ(view->findExtras(ExtrasOwner::node, 0), "");
    EXPECT_EQ(view->findExtras(ExtrasOwner::node, 2), "");
    EXPECT_EQ(view->findExtras(ExtrasOwner::file, 1), "");
    EXPECT_EQ(Opened(PackModel())->findExtras(ExtrasOwner::node, 0), "");
}

TEST(PackView, givesTexels)
{
    const Opened view(smallPack());
    const auto texels = view->imageData(0);
    ASSERT_TRUE(texels.ok());
    EXPECT_EQ(texels->bytes().size(), mipOffset(view->images()[0], 3));
    EXPECT_EQ(mipOffset(view->images()[0], 1), 4u * 2 * 4);
    EXPECT_EQ(mipOffset(view->images()[0], 2), 4u * 2 * 4 + 2 * 1 * 4);
    EXPECT_EQ(view->imageData(2).error().issue, Issue::chunk_missing);
}

TEST(PackView, decodesPages)
{
    const PackModel model = smallPack();
    const Opened view(model);
    for (uint32_t i = 0; i < view->pages().size(); ++i)
    {
        const auto page = view->decodePage(i);
        ASSERT_TRUE(page.ok()) << formatMessage(page.error());
        EXPECT_EQ(*page, model.decoded_pages[i]);
    }
    EXPECT_EQ(view->decodePage(99).error().issue, Issue::meaning_reference);
}

TEST(PackView, refusesPagesThatLieOutside)
{
    PackModel model = smallPack();
    model.pages[0].offset = ~uint64_t{0};
    model.pages[1].stored_size = 0xFFFFFFFF;
    model.pages[2].size = 0xFFFFFFFF;
    model.pages[3].codec = 7;
    const Opened view(model);
    EXPECT_EQ(view->decodePage(0).error().issue, Issue::meaning_range);
    EXPECT_EQ(view->decodePage(1).error().issue, Issue::meaning_range);
    EXPECT_EQ(view->decodePage(2).error().issue, Issue::meaning_value);
    EXPECT_EQ(view->decodePage(3).error().issue, Issue::chunk_codec);
}

TEST(ClusterGeometry, readsEveryAttribute)
{
    const Opened view(smallPack());
    const std::vector<std::byte> page = view->decodePage(1).value();
    const ClusterRecord& cluster = view->clusters()[3];
    const auto found = ClusterGeometry::at(page, cluster, view->meshes()[0]);
    if (!found)
        FAIL() << "the cluster's geometry was not found";
    const ClusterGeometry& geometry = *found;
    EXPECT_EQ(geometry.vertexCount(), 4u);
    EXPECT_EQ(geometry.triangle(1), (std::array<uint32_t, 3>{0, 2, 3}));
    EXPECT_EQ(geometry.position(2), (Float3{2, 0, 1}));
    EXPECT_NEAR(geometry.normal(2).y, 1, 1e-6);
    EXPECT_NEAR(geometry.tangent(2).x, 1, 1e-6);
    EXPECT_EQ(geometry.tangent(2).w, -1);
    EXPECT_EQ(geometry.uv(2, 0), (Float2{0.5f, 1}));
    EXPECT_NEAR(geometry.color(2).y, 0.5f, 0.51f / 255);
    EXPECT_EQ(geometry.color(2).w, 1);
    const shared::VisibilityMoments visibility = geometry.visibility(2);
    EXPECT_NEAR(visibility.m0, 3.14f, 0.05f);
    EXPECT_NEAR(visibility.m1.x, 1, 0.01f);
    EXPECT_NEAR(visibility.m1.y, 2, 0.01f);
    EXPECT_NEAR(visibility.m1.z, 0, 0.01f);
}

TEST(ClusterGeometry, readsInfluencesAndMorphTargets)
{
    const Opened view(smallPack());
    const std::vector<std::byte> page = view->decodePage(3).value();
    const auto found = ClusterGeometry::at(page, view->clusters()[6], view->meshes()[2]);
    if (!found)
        FAIL() << "the cluster's geometry was not found";
    const ClusterGeometry& geometry = *found;
    ASSERT_EQ(geometry.influenceCount(), 4u);
    EXPECT_EQ(geometry.joints(2), (std::array<uint32_t, 8>{1, 0, 0, 0}));
    EXPECT_EQ(geometry.weightCodes(2), (std::array<uint32_t, 8>{40000, 25535, 0, 0}));
    EXPECT_EQ(geometry.weights(2)[0], 40000.0f / 65535);
    ASSERT_EQ(geometry.morphCount(), 1u);
    EXPECT_EQ(geometry.morphTarget(0), 0u);
    EXPECT_EQ(geometry.morphPosition(0, 1), (Float3{0, 0, 0}));
    EXPECT_EQ(geometry.morphPosition(0, 2), (Float3{0, 0.5f, 0}));
    EXPECT_EQ(geometry.morphNormal(0, 2), (Float3{0.5f, -1, 0}));
    // a mesh without targets has no section; a mesh with targets must have one
    MeshRecord mesh = view->meshes()[2];
    const size_t section = 4 * morphSectionWords(1, 3);
    EXPECT_FALSE(
        ClusterGeometry::at(std::span(page).first(page.size() - 4), view->clusters()[6], mesh).has_value());
    EXPECT_FALSE(ClusterGeometry::at(std::span(page).first(page.size() - section), view->clusters()[6], mesh)
                     .has_value());
    mesh.morph_target_count = 0;
    const auto still =
        ClusterGeometry::at(std::span(page).first(page.size() - section), view->clusters()[6], mesh);
    if (!still)
        FAIL() << "the cluster's geometry was not found";
    EXPECT_EQ(still->morphCount(), 0u);
}

TEST(ClusterGeometry, refusesDataOutsideThePage)
{
    const Opened view(smallPack());
    const std::vector<std::byte> page = view->decodePage(1).value();
    ClusterRecord cluster = view->clusters()[3];
    MeshRecord mesh = view->meshes()[0];
    EXPECT_FALSE(ClusterGeometry::at(std::span(page).first(page.size() - 1), cluster, mesh).has_value());
    cluster.page_word = 0xFFFF;
    EXPECT_FALSE(ClusterGeometry::at(page, cluster, mesh).has_value());
    cluster = view->clusters()[3];
    cluster.vertex_count = 0xFFFF;
    EXPECT_FALSE(ClusterGeometry::at(page, cluster, mesh).has_value());
    cluster = view->clusters()[3];
    mesh.attributes = kVertexNormal16;
    EXPECT_FALSE(ClusterGeometry::at(page, cluster, mesh).has_value());
}

TEST(Pack, readsPagesIntoTheCallersMemory)
{
    const PackModel model = smallPack();
    const AlignedBytes bytes = model.bytes();
    const auto pack = pack::Pack::fromBytes(bytes.span(), "small.hearth");
    ASSERT_TRUE(pack.ok());
    std::vector<std::byte> buffer(kMaxPageBytes, std::byte{0xCD});
    const auto page = pack->readPage(2, buffer);
    ASSERT_TRUE(page.ok());
    EXPECT_EQ(page->data(), buffer.data());
    EXPECT_TRUE(std::ranges::equal(*page, model.decoded_pages[2]));
    EXPECT_EQ(buffer[page->size()], std::byte{0xCD});
}

TEST(SelectCut, drawsTheSourceAtZeroAndTheRootsAtInfinity)
{
    const Opened view(smallPack());
    EXPECT_EQ(pack::selectCut(*view, 0, 0), (std::vector<uint32_t>{2, 3, 4, 5}));
    EXPECT_EQ(pack::selectCut(*view, 0, 0.099f), (std::vector<uint32_t>{2, 3, 4, 5}));
    EXPECT_EQ(pack::selectCut(*view, 0, 0.1f), (std::vector<uint32_t>{0, 1}))
        << "an error that is met is allowed";
    EXPECT_EQ(pack::selectCut(*view, 0, kInfinity), (std::vector<uint32_t>{0, 1}));
    EXPECT_TRUE(pack::selectCut(*view, 1, 0).empty());
    EXPECT_EQ(pack::selectCut(*view, 2, kInfinity), (std::vector<uint32_t>{6}));
}

TEST(SelectCut, mixesLevelsWhereGroupsDiffer)
{
    PackModel model = smallPack();
    model.groups[2].error = model.levels[1].max_error = 0.2f;
    const Opened view(model);
    EXPECT_EQ(pack::selectCut(*view, 0, 0.15f), (std::vector<uint32_t>{0, 4, 5}));
}

} // namespace hearth::test

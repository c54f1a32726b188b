// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_check.h"
#include "pipelines/verify/verify_pack.h"
#include "runtime/pack/pack.h"
#include "tests/formats/malformed/malformed_packs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace hearth::test
{

using namespace formats;

namespace
{

/// First error that checkPack reports in any part of the pack.
Status checkWhole(const AlignedBytes& bytes)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::fromBytes(bytes.span(), "small.hearth"));
    HEARTH_ASSIGN_OR_RETURN(const PackView view, PackView::read(std::move(reader)));
    return checkPack(view);
}

/// Formatted message, as in "small.hearth|node 1: ... [E3002] ..."; "" on success.
std::string getMessage(const Status& status)
{
    return status.ok() ? "" : formatMessage(status.error());
}

std::string refusal(const PackModel& model, bool compressed = false)
{
    return getMessage(checkWhole(model.bytes(compressed)));
}

/// First error of reading every page and all texels.
Status readBulk(const pack::Pack& pack)
{
    for (uint32_t page = 0; page < pack->pages().size(); ++page)
    {
        std::vector<std::byte> buffer(pack.pageSize(page), std::byte{0xCD});
        const auto read = pack.readPage(page, buffer);
        if (!read.ok())
        {
            EXPECT_EQ(buffer, std::vector<std::byte>(pack.pageSize(page), std::byte{0xCD}));
            return read.error();
        }
    }
    for (uint32_t image = 0; image < pack->images().size(); ++image)
        HEARTH_TRY(pack->imageData(image));
    return success();
}

} // namespace

TEST(CheckPack, acceptsASmallCompletePack)
{
    EXPECT_EQ(refusal(smallPack()), "");
    EXPECT_EQ(refusal(smallPack(), true), "");
}

TEST(Pack, acceptsWhatTheWholeCheckAccepts)
{
    for (const bool compressed : {false, true})
    {
        const AlignedBytes bytes = smallPack().bytes(compressed);
        const auto pack = pack::Pack::fromBytes(bytes.span(), "small.hearth");
        ASSERT_TRUE(pack.ok()) << formatMessage(pack.error());
        EXPECT_EQ(getMessage(readBulk(*pack)), "");
        EXPECT_EQ(getMessage(pack->checkAll()), "");
    }
}

TEST(CheckPack, acceptsBricksThatAreAllAlike)
{
    // without emission, more than a MiB compresses to a few bytes
    PackModel model;
    model.bricks = brickModel({400, 1, 400}, [](uint32_t, uint32_t, uint32_t) { return true; });
    model.brick_grids = {model.bricks.grid};
    ASSERT_GT(model.bricks.lighting.size() * 4, 1u << 20);
    EXPECT_EQ(refusal(model, true), "");
}

TEST(CheckPack, acceptsAnEmptyScene)
{
    EXPECT_EQ(refusal(PackModel()), "");
}

TEST(CheckPack, acceptsBoundsThatAreExactInFloats)
{
    PackModel pack = smallPack();
    // the distance of the centres is 1, and 1 + 1.5 = 2.5
    pack.groups[0].sphere_radius = 2.5f;
    EXPECT_EQ(refusal(pack), "");
}

TEST(CheckPack, refusesAPart)
{
    const std::vector<ChunkImage> chunks = smallPack().chunks();
    const AlignedBytes bytes = assemble(ContainerKind::part, chunks);
    const auto pack = pack::Pack::fromBytes(bytes.span(), "part");
    ASSERT_FALSE(pack.ok());
    EXPECT_EQ(pack.error().issue, Issue::container_kind);
}

TEST(CheckPack, refusesTexelsWhoseFrameDoesNotNameItsSize)
{
    const PackModel pack = smallPack();
    std::vector<ChunkImage> chunks = pack.chunks(true);
    for (ChunkImage& chunk : chunks)
        if (chunk.entry.type == kChunkImageData && chunk.entry.index == 1)
            chunk = streamedChunk(kChunkImageData, 1, 1, pack.image_data[1]);
    const AlignedBytes bytes = assemble(ContainerKind::pack, chunks);
    const Status whole = checkWhole(bytes);
    ASSERT_FALSE(whole.ok());
    EXPECT_EQ(whole.error().issue, Issue::chunk_codec);
    EXPECT_EQ(whole.error().where, "chunk IMGD 1");
    // texels are read only on request
    const auto opened = pack::Pack::fromBytes(bytes.span(), "small.hearth");
    ASSERT_TRUE(opened.ok());
    EXPECT_EQ(getMessage(readBulk(*opened)), getMessage(whole));
    EXPECT_EQ(getMessage(opened->checkAll()), getMessage(whole));
}

TEST(CheckHierarchy, needsOnlyTheMeshes)
{
    PackModel all = smallPack();
    PackModel meshes;
    meshes.strings = all.strings;
    meshes.meshes = all.meshes;
    meshes.levels = all.levels;
    meshes.groups = all.groups;
    meshes.clusters = all.clusters;
    meshes.pages = all.pages;
    meshes.page_parents = all.page_parents;
    meshes.page_bytes = all.page_bytes;
    const std::vector<ChunkImage> chunks = meshes.chunks();
    const AlignedBytes bytes = assemble(ContainerKind::part, chunks);
    auto reader = ContainerReader::fromBytes(bytes.span(), "clusters.part");
    ASSERT_TRUE(reader.ok());
    const auto view = PackView::read(std::move(reader).value());
    ASSERT_TRUE(view.ok());
    const Status status = checkHierarchy(*view);
    EXPECT_TRUE(status.ok()) << formatMessage(status.error());
}

TEST(CheckPack, reportsTheFirstWrongPageInWhateverOrderPagesAreChecked)
{
    PackModel model = smallPack();
    for (std::vector<std::byte>& page : model.decoded_pages)
        page.back() ^= std::byte{1};
    // the first page is valid
    model.decoded_pages[0].back() ^= std::byte{1};
    model.sealPages();
    const AlignedBytes bytes = model.bytes();
    auto reader = ContainerReader::fromBytes(bytes.span(), "small.hearth");
    ASSERT_TRUE(reader.ok());
    const auto view = PackView::read(std::move(reader).value());
    ASSERT_TRUE(view.ok());
    ASSERT_GE(view->pages().size(), 4u);
    const Status in_turn = checkPack(*view);
    ASSERT_FALSE(in_turn.ok());
    const std::string expected = formatMessage(in_turn.error());
    const uint32_t first_wrong = view->pages()[1].clusters.first + view->pages()[1].clusters.count - 1;
    EXPECT_EQ(in_turn.error().where, "cluster " + std::to_string(first_wrong));

    std::vector<uint32_t> order(view->pages().size());
    std::iota(order.begin(), order.end(), 0u);
    do
    {
        const Status status =
            checkPack(*view, [&](uint32_t, const std::function<void(uint32_t)>& work)
                      { std::for_each(order.begin(), order.end(), [&](uint32_t page) { work(page); }); });
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(formatMessage(status.error()), expected);
    } while (std::next_permutation(order.begin(), order.end()));

    for (int i = 0; i < 100; ++i)
    {
        const Status status = verify::verifyPack(*view);
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(formatMessage(status.error()), expected);
    }
}

TEST(CheckPack, reportsTheFirstWrongVertexAndWhatIsFirstWrongWithIt)
{
    // two words of bases, then six a vertex: the third its tangent, the last its visibility
    const auto spoilTangent = [](PackModel& model, size_t vertex)
    { model.decoded_pages[0][(2 + vertex * 6 + 2) * 4 + 3] = std::byte{0x80}; };
    const auto spoilVisibility = [](PackModel& model, size_t vertex)
    { model.decoded_pages[0][(2 + vertex * 6 + 5) * 4 + 3] = std::byte{0x80}; };
    const auto getRefusal = [&](size_t tangent, size_t visibility)
    {
        PackModel model = smallPack();
        spoilTangent(model, tangent);
        spoilVisibility(model, visibility);
        model.sealPages();
        return refusal(model);
    };
    EXPECT_THAT(getRefusal(1, 3), testing::HasSubstr("vertex 1: its tangent"));
    EXPECT_THAT(getRefusal(3, 1), testing::HasSubstr("vertex 1: its visibility"));
    EXPECT_THAT(getRefusal(2, 2), testing::HasSubstr("vertex 2: its tangent"));
}

/// Return the message of a pack with other extras of its first object.
std::string refusalOfExtras(const std::string& json)
{
    PackModel model = smallPack();
    model.extras[0].json = {static_cast<uint32_t>(model.strings.size()), static_cast<uint32_t>(json.size())};
    model.strings += json;
    const AlignedBytes bytes = model.bytes();
    const auto view =
        PackView::read(ContainerReader::fromBytes(bytes.span(), "small.hearth").value()).value();
    EXPECT_EQ(getMessage(checkPack(view)), "") << "the game's library does not parse extras";
    return getMessage(verify::verifyPack(view));
}

TEST(VerifyPack, refusesExtrasThatAreNotJson)
{
    EXPECT_EQ(refusalOfExtras(R"({"a":[1,2.50,"x"]})"), "");
    for (const char* text : {"{", R"({"a":1)", R"({"a" 1})", "[1,]", "01", "nul", "1 2", R"("\x")"})
        EXPECT_THAT(refusalOfExtras(text),
                    testing::HasSubstr("extras 0: error: the text is not JSON [E3002]"))
            << text;
}

TEST(VerifyPack, refusesExtrasThatAreNestedTooDeeply)
{
    const auto nested = [](size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_EQ(refusalOfExtras(nested(128)), "");
    EXPECT_THAT(refusalOfExtras(nested(129)), testing::HasSubstr("extras 0: error: the JSON text is nested"));
    EXPECT_THAT(refusalOfExtras(nested(1'000'000)), testing::HasSubstr("extras 0: error: the JSON text is"));
}

TEST(VerifyPack, refusesExtrasThatOverlap)
{
    // blanks before a value are JSON: each node has the end of one long text
    PackModel model;
    model.strings = std::string(1000, ' ') + "1";
    for (uint32_t i = 0; i < 3; ++i)
    {
        model.nodes.push_back(smallPack().nodes[0]);
        model.nodes.back().name = {};
        model.extras.push_back({0, i, {i, 1001 - i}});
    }
    model.assets = {{{}, {}, {}, {0, 3}, {}, {}}};
    const auto verified = [&]
    {
        const AlignedBytes bytes = model.bytes();
        return getMessage(verify::verifyPack(
            PackView::read(ContainerReader::fromBytes(bytes.span(), "small.hearth").value()).value()));
    };
    EXPECT_THAT(verified(), testing::HasSubstr("extras 1: error: the texts of extras overlap"));
    for (ExtrasRecord& record : model.extras)
        record.json = {0, 1001};
    EXPECT_EQ(verified(), "") << "objects may share a text";
}

class MalformedPackTest : public testing::TestWithParam<MalformedPack>
{
};

TEST_P(MalformedPackTest, isRefusedAsItsIssue)
{
    PackModel model = smallPack();
    GetParam().spoil(model);
    if (GetParam().reseal)
        model.sealPages();
    const AlignedBytes bytes = model.bytes();
    const Status whole = checkWhole(bytes);
    ASSERT_FALSE(whole.ok()) << "accepted";
    EXPECT_EQ(whole.error().issue, GetParam().issue) << formatMessage(whole.error());
    EXPECT_EQ(whole.error().where, GetParam().where) << formatMessage(whole.error());
}

TEST_P(MalformedPackTest, isRefusedWhenItIsOpenedOrWhenThatPartIsRead)
{
    PackModel model = smallPack();
    GetParam().spoil(model);
    if (GetParam().reseal)
        model.sealPages();
    const AlignedBytes bytes = model.bytes();
    const std::string message = getMessage(checkWhole(bytes));
    const auto pack = pack::Pack::fromBytes(bytes.span(), "small.hearth");
    if (!pack.ok())
    {
        EXPECT_EQ(formatMessage(pack.error()), message);
        return;
    }
    EXPECT_EQ(getMessage(pack->checkAll()), message);
    // bytes between the pages are not accessible
    if (const Status read = readBulk(*pack); !read.ok())
        EXPECT_EQ(formatMessage(read.error()), message);
    else
        EXPECT_EQ(GetParam().issue, Issue::meaning_padding);
}

constexpr auto kCaseName = [](const testing::TestParamInfo<MalformedPack>& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Scene, MalformedPackTest, testing::ValuesIn(malformedScenes()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Deformation, MalformedPackTest, testing::ValuesIn(malformedDeformations()),
                         kCaseName);
INSTANTIATE_TEST_SUITE_P(Provenance, MalformedPackTest, testing::ValuesIn(malformedProvenance()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Specular, MalformedPackTest, testing::ValuesIn(malformedSpecularTables()),
                         kCaseName);
INSTANTIATE_TEST_SUITE_P(Probes, MalformedPackTest, testing::ValuesIn(malformedProbes()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Receivers, MalformedPackTest, testing::ValuesIn(malformedReceivers()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Proxies, MalformedPackTest, testing::ValuesIn(malformedProxies()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Surroundings, MalformedPackTest, testing::ValuesIn(malformedSurroundings()),
                         kCaseName);
INSTANTIATE_TEST_SUITE_P(Bricks, MalformedPackTest, testing::ValuesIn(malformedBricks()), kCaseName);
INSTANTIATE_TEST_SUITE_P(Hierarchy, MalformedPackTest, testing::ValuesIn(malformedHierarchies()), kCaseName);

TEST(CheckReceivers, allowsTexelsBesideRectangles)
{
    PackModel model = smallPack();
    model.receiver_words[1] = 4 | 2 << 14; // below the second rectangle, of 2 x 2 texels
    EXPECT_EQ(refusal(model), "");
}

TEST(MalformedPacks, haveOneForEveryIssueOfMeaning)
{
    for (const IssueInfo& info : allIssues())
    {
        if (static_cast<uint32_t>(info.issue) / 1000 != 3)
            continue;
        const auto has = [&](const std::vector<MalformedPack>& packs)
        {
            return std::any_of(packs.begin(), packs.end(),
                               [&](const MalformedPack& p) { return p.issue == info.issue; });
        };
        EXPECT_TRUE(has(malformedScenes()) || has(malformedHierarchies())) << info.name;
    }
}

} // namespace hearth::test

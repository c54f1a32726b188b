// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/result.h"
#include "formats/gpu_shared/debug_views.h"
#include "formats/records/chunk_list.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace hearth::test
{

using namespace formats;

// HEARTH_RECORD itself asserts that records have no gaps; this shows that it rejects records with gaps.
static_assert(hasNoGaps(std::array{Field{"a", "u32", 0, 4, ""}, Field{"b", "u64", 4, 8, ""}}, 12));
static_assert(!hasNoGaps(std::array{Field{"a", "u32", 0, 4, ""}, Field{"b", "u64", 8, 8, ""}}, 16), "a hole");
static_assert(!hasNoGaps(std::array{Field{"a", "u64", 0, 8, ""}, Field{"b", "u32", 8, 4, ""}}, 16),
              "padding behind");
static_assert(!hasNoGaps(std::array{Field{"b", "u32", 4, 4, ""}, Field{"a", "u32", 0, 4, ""}}, 8),
              "out of order");

TEST(Issues, haveEachANumberOfTheirOwn)
{
    std::map<uint32_t, std::string_view> name_of_number;
    for (const IssueInfo& info : allIssues())
    {
        const auto [other, fresh] = name_of_number.try_emplace(static_cast<uint32_t>(info.issue), info.name);
        EXPECT_TRUE(fresh) << info.name << " and " << other->second << " are both " << other->first;
    }
    EXPECT_GT(name_of_number.size(), 40u);
}

TEST(Issues, sayWhatIsWrongAndWhatToDo)
{
    for (const IssueInfo& info : allIssues())
    {
        EXPECT_FALSE(info.summary.empty()) << info.name;
        EXPECT_TRUE(info.kind == IssueClass::warning || !info.hint.empty()) << info.name;
        EXPECT_EQ(&issueInfo(info.issue), &info);
    }
}

TEST(FormatMessage, isOneLineWithNumberAndHint)
{
    const Error error{Issue::meaning_value, "a.hearth", "node 3", "line\nbreak"};
    EXPECT_EQ(formatMessage(error), "a.hearth|node 3: error: line break [E3002] hint: cook the asset again");
    const Error warning{Issue::dropped, "a.gltf", "", "extras"};
    EXPECT_EQ(formatMessage(warning), "a.gltf: warning: extras [W1400]");
    EXPECT_EQ(exitCode(error), 65);
    EXPECT_EQ(exitCode(warning), 0);
}

TEST(ChunkList, hasEachFourCCOnce)
{
    std::set<uint32_t> types;
    for (const ChunkInfo& chunk : kChunkList)
    {
        EXPECT_TRUE(types.insert(chunk.type).second) << chunk.meaning;
        EXPECT_EQ(chunkInfo(chunk.type), &chunk);
        EXPECT_NE(chunk.content.empty(), chunk.record.name.empty()) << chunk.meaning;
    }
    EXPECT_EQ(chunkInfo(fourCC("NEW!")), nullptr);
}

TEST(DebugViews, haveEachNumberAndNameOnce)
{
    std::set<uint32_t> numbers;
    std::set<std::string_view> names;
    for (const shared::DebugView& view : shared::kDebugViews)
    {
        EXPECT_TRUE(numbers.insert(view.number).second) << view.name;
        EXPECT_TRUE(names.insert(view.name).second) << view.name;
        EXPECT_EQ(shared::findDebugView(view.number), &view);
    }
    EXPECT_EQ(*numbers.rbegin(), numbers.size() - 1) << "numbers have no gap";
    EXPECT_EQ(shared::kDebugViews.front().number, shared::kViewFinal);
    EXPECT_EQ(shared::findDebugView(1000), nullptr);
}

TEST(VertexWords, areTheOffsetBehindTheLastAttribute)
{
    EXPECT_EQ(vertexWords(0), 2u);
    EXPECT_EQ(vertexWords(kVertexNormal), 2u) << "beside z";
    EXPECT_EQ(vertexWords(kVertexNormal | kVertexNormal16), 3u);
    const uint32_t grids = 0xEEEEu << kVertexUvStepShift, second_floats = 0xEE0Eu << kVertexUvStepShift;
    EXPECT_EQ(vertexWords(127), 12u);
    EXPECT_EQ(vertexWords(127 | grids), 8u);
    EXPECT_EQ(vertexWords(127 | grids | kVertexWideOffsets), 14u);
    EXPECT_EQ(vertexWords(127 | second_floats), 9u);
    EXPECT_EQ(vertexWords(127 | second_floats | kVertexWideOffsets), 14u);
    EXPECT_EQ(vertexWords(255 | grids), 9u);
    EXPECT_EQ(vertexWords(kVertexNormal | kVertexVisibility), 3u);
    EXPECT_EQ(vertexWords(kVertexColor | kVertexColor16), 4u);
    EXPECT_EQ(vertexWords(kVertexNormal | kVertexInfluences), 6u);
    EXPECT_EQ(vertexWords(kVertexNormal | kVertexInfluences | kVertexInfluences8), 10u);
}

} // namespace hearth::test

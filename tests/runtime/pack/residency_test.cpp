// Tests the streaming policy: small cases with known answers, and random histories against a slow model of
// the rules.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/pack/streaming_caller.h"
#include "tests/support/sanitized.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using pack::PageNode;
using pack::Residency;
using pack::ResidencyOptions;
using testing::ElementsAre;
using testing::IsEmpty;
using Requests = StreamingCaller::Requests;

/// A root of 10 bytes, page 0, and `count` pages of 10 bytes that need only the root.
std::vector<PageNode> star(uint32_t count)
{
    std::vector<PageNode> nodes(1 + count, PageNode{10, false, {0}, {}});
    nodes[0] = {10, true, {}, {}};
    return nodes;
}

/// Pages of 10 bytes; each needs the one before, and the first is a root.
std::vector<PageNode> chain(uint32_t count)
{
    std::vector<PageNode> nodes(count, PageNode{10, false, {}, {}});
    for (uint32_t page = 1; page < count; ++page)
        nodes[page].needs = {page - 1};
    nodes[0].holds_root = true;
    return nodes;
}

Residency makeResidency(const std::vector<PageNode>& nodes, const ResidencyOptions& options)
{
    auto residency = Residency::create(pack::PageGraph(nodes), options);
    HEARTH_ASSERT(residency.ok());
    return std::move(*residency);
}

/// Load and publish pages, which must all fit, in frame `serial`; they are requested with priority 1.
void makeResident(Residency& residency, uint64_t serial, const std::vector<uint32_t>& pages)
{
    for (const uint32_t page : pages)
        residency.request(page, 1);
    const auto started = residency.schedule();
    for (const uint32_t page : std::vector(started.begin(), started.end()))
        residency.completed(page, true);
    residency.beginFrame(serial, serial - 1);
    for (const uint32_t page : pages)
        ASSERT_TRUE(residency.isResident(page));
}

TEST(Residency, E4006_budgetWithoutRoomForTheRoots)
{
    std::vector<PageNode> nodes = chain(3);
    nodes[1].holds_root = true;
    const auto residency = Residency::create(pack::PageGraph(nodes), {.budget_bytes = 19});
    ASSERT_FALSE(residency.ok());
    EXPECT_EQ(residency.error().issue, Issue::streaming_budget);
    EXPECT_THAT(residency.error().detail, testing::HasSubstr("take 20"));
    EXPECT_TRUE(Residency::create(pack::PageGraph(nodes), {.budget_bytes = 20}).ok());
}

TEST(Residency, beginsWithTheRootsAndWhatTheyNeed)
{
    std::vector<PageNode> nodes = chain(4);
    nodes[2].holds_root = true;
    const Residency residency = makeResidency(nodes, {.budget_bytes = 100});
    EXPECT_THAT(residency.graph().pinned(), ElementsAre(0, 1, 2));
    EXPECT_EQ(residency.bytesInUse(), 30u);
    EXPECT_FALSE(residency.isResident(3));
}

TEST(Residency, loadsWhatAPageNeedsBeforeIt)
{
    Residency residency = makeResidency(chain(4), {.budget_bytes = 100});
    residency.beginFrame(1, 0);
    residency.request(3, 5);
    EXPECT_THAT(residency.schedule(), ElementsAre(1, 2, 3));
    residency.completed(3, true);
    residency.completed(1, true);
    EXPECT_THAT(residency.beginFrame(2, 1).published, ElementsAre(1)) << "3 waits for 2";
    residency.completed(2, true);
    EXPECT_THAT(residency.beginFrame(3, 2).published, ElementsAre(2, 3));
}

TEST(Residency, startsTheLargestPriorityFirstThenTheLowestNumber)
{
    Residency residency = makeResidency(star(5), {.budget_bytes = 100, .max_loads = 4});
    residency.beginFrame(1, 0);
    for (const auto& [page, priority] :
         Requests{{5, 2}, {2, 2}, {3, 1}, {4, 1.5f}, {1, 0.5f}, {3, 9}, {3, 2}})
        residency.request(page, priority);
    EXPECT_THAT(residency.schedule(), ElementsAre(3, 2, 5, 4)) << "of several requests the largest counts";
    residency.request(1, 1);
    EXPECT_THAT(residency.schedule(), IsEmpty()) << "four loads are in flight";
    residency.completed(5, true);
    residency.request(1, 1);
    EXPECT_THAT(residency.schedule(), ElementsAre(1));
}

TEST(Residency, aPageMakesRoomOnlyForTwiceItsPriority)
{
    Residency residency = makeResidency(star(2), {.budget_bytes = 20});
    makeResident(residency, 1, {1});
    residency.request(1, 1);
    residency.request(2, 2);
    residency.schedule();
    EXPECT_THAT(residency.beginFrame(2, 1).evicted, IsEmpty());
    residency.request(1, 1);
    residency.request(2, 2.01f);
    residency.schedule();
    EXPECT_THAT(residency.beginFrame(3, 2).evicted, ElementsAre(1));
}

TEST(Residency, whatIsNoLongerRequestedLosesHalfItsWorthEachRound)
{
    Residency residency = makeResidency(star(3), {.budget_bytes = 30});
    makeResident(residency, 1, {1, 2});
    residency.request(1, 8);
    residency.request(2, 8);
    residency.schedule();
    for (uint64_t serial = 2; serial < 5; ++serial)
    {
        EXPECT_THAT(residency.beginFrame(serial, serial - 1).evicted, IsEmpty()) << "worth 8, 4, 2 ...";
        residency.request(3, 2.5f);
        residency.request(1, 1.5f);
        residency.schedule();
    }
    EXPECT_THAT(residency.beginFrame(5, 4).evicted, ElementsAre(2))
        << "1 after three rounds; page 1 is worth 1.5 since it is requested";
}

TEST(Residency, reusesMemoryOnceNoFrameReadsIt)
{
    Residency residency = makeResidency(star(2), {.budget_bytes = 20});
    makeResident(residency, 1, {1});
    residency.request(2, 9);
    EXPECT_THAT(residency.schedule(), IsEmpty());
    EXPECT_TRUE(residency.isResident(1)) << "frame 1 still draws it";

    auto changes = residency.beginFrame(2, 0);
    EXPECT_THAT(changes.evicted, ElementsAre(1));
    EXPECT_THAT(changes.released, IsEmpty());
    residency.request(2, 9);
    EXPECT_THAT(residency.schedule(), IsEmpty());

    EXPECT_THAT(residency.beginFrame(3, 1).released, ElementsAre(1));
    residency.request(2, 9);
    EXPECT_THAT(residency.schedule(), ElementsAre(2));
}

TEST(Residency, evictsAChainFromItsEndAndNoMoreThanHelps)
{
    std::vector<PageNode> nodes = chain(4);
    nodes.push_back({20, false, {0}, {}});
    nodes.push_back({31, false, {0}, {}});
    Residency residency = makeResidency(nodes, {.budget_bytes = 40});
    makeResident(residency, 1, {3});
    residency.request(5, 100);
    residency.schedule();
    EXPECT_THAT(residency.beginFrame(2, 1).evicted, IsEmpty()) << "even without all three there is no room";
    residency.request(4, 100);
    residency.schedule();
    EXPECT_THAT(residency.beginFrame(3, 2).evicted, ElementsAre(3, 2));
}

TEST(Residency, tellsAFailureOnceAndStartsNothingThatNeedsThePage)
{
    Residency residency = makeResidency(chain(3), {.budget_bytes = 100});
    residency.beginFrame(1, 0);
    residency.request(2, 5);
    EXPECT_THAT(residency.schedule(), ElementsAre(1, 2));
    residency.completed(1, false);
    residency.completed(2, true);
    auto changes = residency.beginFrame(2, 1);
    EXPECT_THAT(changes.failed, ElementsAre(1));
    EXPECT_THAT(changes.discarded, ElementsAre(2));
    EXPECT_EQ(residency.bytesInUse(), 10u);

    residency.request(2, 5);
    EXPECT_THAT(residency.schedule(), IsEmpty());
    EXPECT_THAT(residency.beginFrame(3, 2).failed, IsEmpty());
    residency.retryFailed();
    residency.request(2, 5);
    EXPECT_THAT(residency.schedule(), ElementsAre(1, 2));
}

TEST(Residency, aLoadBeyondAFailureStaysWhereTheFailureIsRetriedInTime)
{
    Residency residency = makeResidency(chain(3), {.budget_bytes = 100});
    residency.beginFrame(1, 0);
    residency.request(2, 5);
    residency.schedule();
    residency.completed(1, false);
    residency.retryFailed();
    residency.request(2, 5);
    EXPECT_THAT(residency.schedule(), ElementsAre(1));
    residency.completed(1, true);
    residency.completed(2, true);
    EXPECT_THAT(residency.beginFrame(2, 1).published, ElementsAre(1, 2));
}

TEST(Residency, requestsCompanionsOfWhatIsRequestedAlone)
{
    std::vector<PageNode> nodes = star(4);
    nodes[1].companions = {2};
    nodes[2].companions = {3};
    Residency residency = makeResidency(nodes, {.budget_bytes = 100});
    residency.beginFrame(1, 0);
    residency.request(1, 5);
    EXPECT_THAT(residency.schedule(), ElementsAre(1, 2));
}

Requests randomRequests(std::mt19937& random, size_t page_count)
{
    Requests requests;
    const size_t count = random() % (page_count + 1);
    for (size_t i = 0; i < count; ++i)
        requests.emplace_back(static_cast<uint32_t>(random() % page_count),
                              static_cast<float>(random() % 4096) / 256.0f);
    return requests;
}

Machine randomMachine(std::mt19937& random)
{
    Machine machine;
    machine.most_load_frames = 1 + static_cast<uint32_t>(random() % 5);
    machine.most_frames_late = static_cast<uint32_t>(random() % 4);
    return machine;
}

/// Random budget from the roots alone to all pages.
ResidencyOptions randomOptions(std::mt19937& random, const std::vector<PageNode>& nodes)
{
    ResidencyOptions options;
    const uint64_t pinned = pinnedBytes(nodes);
    options.budget_bytes = pinned + random() % (allBytes(nodes) - pinned + 1);
    options.max_loads = 1 + static_cast<uint32_t>(random() % 8);
    options.hysteresis = static_cast<float>(1u << random() % 3);
    return options;
}

TEST(Streaming, keepsItsPromisesThroughRandomHistories)
{
    std::mt19937 random(1);
    uint64_t starts = 0, evictions = 0, failures = 0;
    for (uint32_t seed = 0; seed < trials(1000) && !testing::Test::HasFailure(); ++seed)
    {
        SCOPED_TRACE("history " + std::to_string(seed));
        const auto nodes = randomPages(random, 40);
        Machine machine = randomMachine(random);
        machine.failures_of_64 = random() % 2 != 0 ? static_cast<uint32_t>(random() % 16) : 0;
        StreamingCaller caller(nodes, randomOptions(random, nodes), machine, seed);
        Requests requests;
        for (int frame = 0; frame < 100; ++frame)
        {
            // requests that persist for a while, like those of a view
            if (random() % 8 == 0 || frame == 0)
                requests = randomRequests(random, nodes.size());
            if (random() % 16 == 0)
                caller.retryFailed();
            if (random() % 12 == 0 && seed % 2 == 1)
                caller.setBudget(randomOptions(random, nodes).budget_bytes);
            caller.frame(random() % 8 == 0 ? Requests{} : requests);
        }
        starts += caller.startCount();
        evictions += caller.evictionCount();
        for (const auto& [page, count] : caller.failureCounts())
            failures += count;
    }
    EXPECT_GT(starts, trials(10000));
    EXPECT_GT(evictions, trials(2000));
    EXPECT_GT(failures, trials(500));
}

/// Wanted pages with their effective priorities: companions of the requests, then all pages that these need,
/// and the roots.
std::map<uint32_t, float> wantedPages(const std::vector<PageNode>& nodes, const Requests& requests)
{
    std::map<uint32_t, float> requested;
    const auto raise = [](auto& wanted, uint32_t page, float priority) {
        wanted[page] = std::max({wanted[page], priority, std::numeric_limits<float>::min()});
    };
    for (const auto& [page, priority] : requests)
        raise(requested, page, priority);
    std::map<uint32_t, float> wanted = requested;
    for (const auto& [page, priority] : requested)
        for (const uint32_t companion : nodes[page].companions)
            raise(wanted, companion, priority);
    const std::map<uint32_t, float> heads = wanted;
    for (const auto& [page, priority] : heads)
        for (const uint32_t needed : computeClosure(nodes, {page}))
            raise(wanted, needed, priority);
    return wanted;
}

std::vector<std::pair<float, uint32_t>> inOrder(const std::map<uint32_t, float>& wanted)
{
    std::vector<std::pair<float, uint32_t>> order;
    for (const auto& [page, priority] : wanted)
        order.emplace_back(-priority, page);
    std::sort(order.begin(), order.end());
    return order;
}

std::set<uint32_t> pinnedPages(const std::vector<PageNode>& nodes)
{
    const pack::PageGraph graph(nodes);
    return {graph.pinned().begin(), graph.pinned().end()};
}

uint64_t sumBytes(const std::vector<PageNode>& nodes, const std::set<uint32_t>& pages)
{
    uint64_t bytes = 0;
    for (const uint32_t page : pages)
        bytes += nodes[page].size_bytes;
    return bytes;
}

/// Number of frames in which all pages surely load one after the other, once resident pages have lost their
/// worth.
uint32_t framesEnough(const std::vector<PageNode>& nodes, const Machine& machine)
{
    return 40 +
           static_cast<uint32_t>(nodes.size()) * (machine.most_load_frames + machine.most_frames_late + 3);
}

TEST(Streaming, bringsExactlyWhatIsWantedWhereItFits)
{
    std::mt19937 random(2);
    for (uint32_t seed = 0; seed < 300 && !testing::Test::HasFailure(); ++seed)
    {
        SCOPED_TRACE("history " + std::to_string(seed));
        const auto nodes = randomPages(random, 40);
        const Requests requests = randomRequests(random, nodes.size());
        std::set<uint32_t> wanted = pinnedPages(nodes);
        for (const auto& [page, priority] : wantedPages(nodes, requests))
            wanted.insert(page);
        ResidencyOptions options = randomOptions(random, nodes);
        options.budget_bytes = sumBytes(nodes, wanted);
        const Machine machine = randomMachine(random);

        StreamingCaller fresh(nodes, options, machine, seed);
        EXPECT_LT(fresh.settle(requests), framesEnough(nodes, machine));
        EXPECT_EQ(fresh.residentPages(), std::vector(wanted.begin(), wanted.end()));
        EXPECT_EQ(fresh.residency().errorScale(), 1.0f);

        StreamingCaller used(nodes, options, machine, seed);
        used.settle(randomRequests(random, nodes.size()), 30);
        EXPECT_LT(used.settle(requests), framesEnough(nodes, machine));
        EXPECT_EQ(used.residentPages(), fresh.residentPages()) << "whatever was there before";
    }
}

/// Pages from the greatest priority down, until one does not fit.
std::set<uint32_t> mostImportant(const std::vector<PageNode>& nodes, const Requests& requests,
                                 uint64_t budget)
{
    std::set<uint32_t> pages = pinnedPages(nodes);
    uint64_t bytes = sumBytes(nodes, pages);
    for (const auto& [negative_priority, page] : inOrder(wantedPages(nodes, requests)))
    {
        if (pages.count(page) != 0)
            continue;
        bytes += nodes[page].size_bytes;
        if (bytes > budget)
            break;
        pages.insert(page);
    }
    return pages;
}

/// Expect that the first absent page does not fit beside the resident pages that it must not evict.
void expectNothingMoreFits(const std::vector<PageNode>& nodes, const StreamingCaller& caller,
                           const Requests& requests, const ResidencyOptions& options)
{
    const std::map<uint32_t, float> wanted = wantedPages(nodes, requests);
    for (const auto& [negative_priority, absent] : inOrder(wanted))
    {
        if (caller.resident()[absent] != 0)
            continue;
        std::set<uint32_t> kept = pinnedPages(nodes);
        for (const auto& [page, priority] : wanted)
            if (caller.resident()[page] != 0 && priority * options.hysteresis >= -negative_priority)
                kept.merge(computeClosure(nodes, {page}));
        EXPECT_GT(sumBytes(nodes, kept) + nodes[absent].size_bytes, options.budget_bytes)
            << "page " << absent;
        return;
    }
}

TEST(Streaming, comesToRestWithTheMostImportantWhereNotAllFits)
{
    std::mt19937 random(3);
    uint32_t short_of_room = 0;
    for (uint32_t seed = 0; seed < 300 && !testing::Test::HasFailure(); ++seed)
    {
        SCOPED_TRACE("history " + std::to_string(seed));
        const auto nodes = randomPages(random, 40);
        const Requests requests = randomRequests(random, nodes.size());
        const ResidencyOptions options = randomOptions(random, nodes);
        const Machine machine = randomMachine(random);
        const std::set<uint32_t> best = mostImportant(nodes, requests, options.budget_bytes);
        short_of_room += best.size() < wantedPages(nodes, requests).size();

        StreamingCaller fresh(nodes, options, machine, seed);
        EXPECT_LT(fresh.settle(requests), framesEnough(nodes, machine));
        EXPECT_EQ(fresh.residentPages(), std::vector(best.begin(), best.end()));

        StreamingCaller used(nodes, options, machine, seed);
        used.settle(randomRequests(random, nodes.size()), 30);
        EXPECT_LT(used.settle(requests), 4 * framesEnough(nodes, machine)) << "pages take turns";
        expectNothingMoreFits(nodes, used, requests, options);
    }
    EXPECT_GT(short_of_room, 100u);
}

TEST(Streaming, lacksNothingButWhatNeedsAFailedPage)
{
    std::mt19937 random(4);
    uint32_t failures = 0;
    for (uint32_t seed = 0; seed < 200 && !testing::Test::HasFailure(); ++seed)
    {
        SCOPED_TRACE("history " + std::to_string(seed));
        const auto nodes = randomPages(random, 40);
        const Requests requests = randomRequests(random, nodes.size());
        ResidencyOptions options = randomOptions(random, nodes);
        options.budget_bytes = allBytes(nodes);
        Machine machine = randomMachine(random);
        const auto bad = static_cast<uint32_t>(random() % nodes.size());
        machine.bad_pages = {bad};

        StreamingCaller caller(nodes, options, machine, seed);
        caller.settle(requests);
        const auto pinned = pinnedPages(nodes);
        const auto wanted = wantedPages(nodes, requests);
        const bool tried = wanted.count(bad) != 0 && pinned.count(bad) == 0;
        failures += tried;
        EXPECT_EQ(caller.failureCounts(),
                  tried ? (std::map<uint32_t, uint32_t>{{bad, 1}}) : (std::map<uint32_t, uint32_t>{}));
        for (uint32_t page = 0; page < nodes.size(); ++page)
        {
            const bool lost = tried && computeClosure(nodes, {page}).count(bad) != 0;
            const bool expected = pinned.count(page) != 0 || (wanted.count(page) != 0 && !lost);
            EXPECT_EQ(caller.resident()[page] != 0, expected) << "page " << page;
        }
        EXPECT_EQ(caller.residency().errorScale(), 1.0f);

        caller.retryFailed();
        caller.mend();
        caller.settle(requests);
        for (const auto& [page, priority] : wanted)
            EXPECT_NE(caller.resident()[page], 0) << "page " << page;
    }
    EXPECT_GT(failures, 50u);
}

TEST(ErrorScale, risesSlowlyWhileMoreIsWantedThanFitsAndFallsAgain)
{
    Residency residency = makeResidency(star(9), {.budget_bytes = 50});
    residency.beginFrame(1, 0);
    float before = 1;
    for (int round = 0; round < 100; ++round)
    {
        for (uint32_t page = 1; page < 10; ++page)
            residency.request(page, 3);
        residency.schedule();
        EXPECT_GE(residency.errorScale(), before);
        EXPECT_LE(residency.errorScale(), before * 1.126f);
        before = residency.errorScale();
    }
    EXPECT_EQ(before, pack::ErrorScale::kMaxScale);
    for (uint32_t page = 1; page < 10; ++page)
        residency.request(page, 1);
    residency.schedule();
    EXPECT_LT(residency.errorScale(), before) << "what would not be drawn asks for nothing";
    for (int round = 0; round < 1000; ++round)
        residency.schedule();
    EXPECT_EQ(residency.errorScale(), 1.0f);
}

TEST(ErrorScale, doesNotCountWhatNeedsAFailedPage)
{
    Residency residency = makeResidency(chain(3), {.budget_bytes = 20});
    residency.beginFrame(1, 0);
    residency.request(1, 5);
    EXPECT_THAT(residency.schedule(), ElementsAre(1));
    residency.completed(1, false);
    residency.request(2, 5);
    residency.schedule();
    EXPECT_EQ(residency.errorScale(), 1.0f);
    residency.retryFailed();
    residency.request(2, 5);
    residency.schedule();
    EXPECT_GT(residency.errorScale(), 1.0f) << "30 bytes are wanted";
}

TEST(ErrorScale, settlesWhereWhatIsDrawnFits)
{
    // errors decrease by a tenth from page to page; feedback is three frames late
    Residency residency = makeResidency(star(40), {.budget_bytes = 160});
    std::vector<float> scales{1, 1, 1};
    for (uint64_t serial = 1; serial < 300; ++serial)
    {
        residency.beginFrame(serial, serial - 1);
        float error = 20;
        for (uint32_t page = 1; page <= 40; ++page, error *= 0.9f)
            if (error / scales[scales.size() - 3] > 1)
                residency.request(page, error / scales[scales.size() - 3]);
        const auto started = residency.schedule();
        for (const uint32_t page : std::vector(started.begin(), started.end()))
            residency.completed(page, true);
        scales.push_back(residency.errorScale());
    }
    EXPECT_EQ(scales[200], scales.back()) << "it rests";
    uint32_t drawn = 0;
    float error = 20;
    for (uint32_t page = 1; page <= 40; ++page, error *= 0.9f)
        if (error / scales.back() > 1)
        {
            ++drawn;
            EXPECT_TRUE(residency.isResident(page));
        }
    EXPECT_LE(drawn, 15u);
    EXPECT_GE(drawn, 11u) << "and uses most of the budget";
}

TEST(ErrorScale, restsAboveAJumpUntilSomethingElseIsWanted)
{
    // At a scale below 3 the wanted pages do not fit; above, they take half of the budget. Feedback is three
    // updates late.
    pack::ErrorScale scale;
    std::vector<float> values{1, 1, 1};
    const auto play = [&](uint64_t coarse, int updates)
    {
        for (int i = 0; i < updates; ++i)
        {
            scale.update(values[values.size() - 3] < 3 ? 130 : coarse, 100);
            values.push_back(scale.value());
        }
    };
    play(50, 400);
    EXPECT_EQ(values[200], values.back()) << "it rests";
    EXPECT_GE(values.back(), 3);
    EXPECT_LT(values.back(), 3.6f);
    play(40, 5);
    EXPECT_LT(scale.value(), values[200]) << "it looks again";
    play(40, 400);
    EXPECT_GE(values.back(), 3);
    EXPECT_EQ(values[values.size() - 100], values.back());
}

} // namespace
} // namespace hearth::test

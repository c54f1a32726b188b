// Tests the search for the share of geometry in one memory budget: against a model that keeps all
// rounds, and with error scales that follow demands.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/error_scale.h"
#include "runtime/pack/memory_balance.h"
#include "tests/support/sanitized.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace hearth::test
{

namespace
{

using pack::MemoryBalance;
using pack::MemoryDemand;
using pack::MemoryRange;

/// Rules of MemoryBalance, from all rounds since the start.
class BalanceModel
{
public:
    explicit BalanceModel(const MemoryRange& range) : range_(range), share_(range.start_granules)
    {
        rounds_.push_back({1, 1, 0, 0});
    }

    uint32_t update(const MemoryDemand& pages, const MemoryDemand& texels)
    {
        rounds_.push_back({pages.error_scale, texels.error_scale, static_cast<float>(pages.wanted_bytes),
                           static_cast<float>(texels.wanted_bytes)});
        const Round& now = rounds_.back();
        if (ended_ && (isOther(now.geometry, now.page_bytes, ended_->geometry, ended_->page_bytes) ||
                       isOther(now.textures, now.texel_bytes, ended_->textures, ended_->texel_bytes)))
            forget();
        if (!hasPersisted())
            return share_;
        base_ = rounds_.size() - 1;
        if (side(rounds_.back()) == 0)
            forget();
        else if (!ended_)
            decide(rounds_.back());
        return share_;
    }

private:
    struct Round
    {
        float geometry, textures; ///< scales
        float page_bytes, texel_bytes;
    };

    /// True if no constant demand wants so many bytes at this scale and those before at that.
    static bool isOther(float scale, float bytes, float scale_before, float bytes_before)
    {
        const bool is_more = bytes > 1.25f * bytes_before;
        const bool is_less = bytes_before > 1.25f * bytes && scale <= scale_before;
        return scale_before > 1.25f * scale || is_more || is_less;
    }
    /// Return 1 where geometry is worse off, -1 where textures are.
    static int side(const Round& round)
    {
        const float g = round.geometry, t = round.textures;
        if (g > 1.25f * t || (t == 1 && g > 1))
            return 1;
        return t > 1.25f * g || (g == 1 && t > 1) ? -1 : 0;
    }

    /// True if the last 33 rounds since the last time are on one side, and the gap narrows from neither
    /// side after the first of them; where both sides are even, if nothing changes.
    bool hasPersisted() const
    {
        size_t first = base_;
        for (size_t i = base_ + 1; i < rounds_.size(); ++i)
        {
            const Round &begin = rounds_[first], &now = rounds_[i];
            const bool geometry_is_worse = side(now) > 0;
            const float worse = geometry_is_worse ? now.geometry : now.textures;
            const float worse_before = geometry_is_worse ? begin.geometry : begin.textures;
            const float better = geometry_is_worse ? now.textures : now.geometry;
            const float better_before = geometry_is_worse ? begin.textures : begin.geometry;
            const bool narrows = side(now) == 0
                                     ? worse != worse_before || better != better_before
                                     : worse_before > 1.125f * worse || better > 1.125f * better_before;
            if (side(now) != side(begin) || narrows)
                first = i;
        }
        return rounds_.size() - 1 - first >= 32;
    }

    void forget()
    {
        geometry_worse_.clear();
        textures_worse_.clear();
        retried_ = false;
        ended_.reset();
        last_side_ = 0;
    }

    void decide(const Round& round)
    {
        const int64_t now = share_;
        const bool more = side(round) > 0;
        (more ? geometry_worse_ : textures_worse_).insert(now);
        auto& others = more ? textures_worse_ : geometry_worse_;
        if (!others.empty() && (more ? *others.begin() <= now : *others.rbegin() >= now))
            others.clear();
        // a bound at which the other side would have all that it wants is none
        const float better = more ? round.textures : round.geometry;
        const float bytes = more ? round.texel_bytes : round.page_bytes;
        if (!others.empty() && better == 1 &&
            bytes <= bytesAt(more ? *others.begin() : *others.rbegin(), more))
        {
            others.clear();
            retried_ = false;
        }
        const int64_t low = geometry_worse_.empty() ? -1 : *geometry_worse_.rbegin();
        const int64_t high =
            textures_worse_.empty() ? int64_t{range_.granules} + 1 : *textures_worse_.begin();
        if (low + 1 < high)
        {
            // steps of 1, 2, 4 .. in a row, or to the middle before a bound
            in_a_row_ = side(round) == last_side_ ? in_a_row_ + 1 : 0;
            last_side_ = side(round);
            int64_t far = int64_t{1} << in_a_row_;
            if (!others.empty())
                far = std::min(far, std::abs((more ? high : low) - now) / 2);
            const int64_t best = bestShare(round);
            share_ = static_cast<uint32_t>(
                std::clamp(more ? std::max(best, now + far) : std::min(best, now - far), low + 1, high - 1));
            return;
        }
        if (others.empty() || retried_)
        {
            ended_ = round;
            return;
        }
        retried_ = true;
        share_ = static_cast<uint32_t>(more ? high : low);
        others.clear();
    }

    /// Return the bytes of textures, or of pages, at a share.
    float bytesAt(int64_t share, bool of_textures) const
    {
        const auto pages = static_cast<float>(range_.fixed_bytes) +
                           static_cast<float>(share) * static_cast<float>(range_.granule_bytes);
        return of_textures ? static_cast<float>(range_.total_bytes) - pages : pages;
    }

    /// Return the share, rounded, that bytes of the demands at a scale of 1 have in their sum.
    int64_t bestShare(const Round& round) const
    {
        const auto total = static_cast<double>(range_.total_bytes);
        const double own = static_cast<double>(range_.fixed_bytes + range_.granule_bytes * share_);
        const double pages = own * std::pow(round.geometry, 2.0);
        const double texels = (total - own) * std::pow(round.textures, 2.0);
        const double bytes = total * pages / (pages + texels) - static_cast<double>(range_.fixed_bytes);
        return static_cast<int64_t>(std::floor(bytes / static_cast<double>(range_.granule_bytes) + 0.5));
    }

    MemoryRange range_;
    uint32_t share_;
    std::vector<Round> rounds_;
    size_t base_ = 0;                                   ///< round of the last decision
    std::set<int64_t> geometry_worse_, textures_worse_; ///< shares
    bool retried_ = false;
    int last_side_ = 0; ///< of the last decision
    int in_a_row_ = 0;  ///< decisions before it for the same side
    std::optional<Round> ended_;
};

MemoryRange makeRange(std::mt19937& random)
{
    MemoryRange range;
    range.granule_bytes = 1 + random() % 1000;
    range.granules = static_cast<uint32_t>(random() % 14);
    range.fixed_bytes = random() % 3000;
    range.total_bytes = range.fixed_bytes + range.granules * range.granule_bytes + 1 + random() % 3000;
    range.start_granules = static_cast<uint32_t>(random() % (range.granules + 1));
    return range;
}

TEST(MemoryBalance, followsItsModelThroughRandomHistories)
{
    std::mt19937 random(1);
    const auto scale = [&] { return random() % 3 == 0 ? 1.0f : 1 + static_cast<float>(random() % 64) / 16; };
    size_t moves = 0;
    for (size_t trial = 0; trial < trials(300) && !testing::Test::HasFailure(); ++trial)
    {
        const MemoryRange range = makeRange(random);
        MemoryBalance balance(range);
        BalanceModel model(range);
        MemoryDemand geometry{scale(), 100}, textures{scale(), 100};
        for (int round = 0; round < 1500; ++round)
        {
            if (random() % 64 == 0)
                (random() % 2 == 0 ? geometry : textures) = {scale(), 100 + random() % 4000};
            if (random() % 128 == 0)
                geometry.error_scale = std::max(1.0f, geometry.error_scale * 0.97f);
            const uint32_t before = balance.share();
            ASSERT_EQ(balance.update(geometry, textures), model.update(geometry, textures)) << round;
            moves += balance.share() != before ? 1u : 0u;
        }
    }
    EXPECT_GT(moves, trials(1000));
}

/// Bytes that are wanted at a scale.
using Demand = std::function<double(double)>;

/// Demand that falls with a power of the scale, in steps of some bytes; large ones if it is lumpy.
Demand makeDemand(std::mt19937& random, double total, bool is_lumpy)
{
    const double bytes = total * std::exp2(static_cast<double>(random() % 64) / 8 - 4);
    const double power = 1.5 + static_cast<double>(random() % 9) / 8;
    const double step = is_lumpy ? total / 3 : total / 4096;
    return [=](double scale) { return std::floor(bytes * std::pow(scale, -power) / step) * step; };
}

/// Both sides of a budget with constant demands.
struct Sides
{
    MemoryRange range{.total_bytes = 64 << 20,
                      .fixed_bytes = 8 << 20,
                      .granule_bytes = 4 << 20,
                      .granules = 12,
                      .start_granules = 6};
    Demand pages, texels;
    pack::ErrorScale geometry, textures;

    double pageBytes(uint32_t share) const
    {
        return static_cast<double>(range.fixed_bytes + share * range.granule_bytes);
    }
    double texelBytes(uint32_t share) const
    {
        return static_cast<double>(range.total_bytes) - pageBytes(share);
    }

    /// Run a round.
    void round(MemoryBalance& balance)
    {
        const auto feed = [](pack::ErrorScale& scale, const Demand& demand, double bytes)
        { scale.update(static_cast<uint64_t>(demand(double{scale.value()})), static_cast<uint64_t>(bytes)); };
        feed(geometry, pages, pageBytes(balance.share()));
        feed(textures, texels, texelBytes(balance.share()));
        const auto measure = [](const pack::ErrorScale& scale, const Demand& demand) {
            return MemoryDemand{scale.value(), static_cast<uint64_t>(demand(double{scale.value()}))};
        };
        balance.update(measure(geometry, pages), measure(textures, texels));
    }

    /// Run rounds until no memory has moved for 400 of them; returns the moves.
    uint32_t settle(MemoryBalance& balance)
    {
        uint32_t moves = 0;
        for (int quiet = 0; quiet < 400; ++quiet)
        {
            const uint32_t before = balance.share();
            round(balance);
            if (balance.share() != before)
            {
                ++moves;
                quiet = 0;
            }
            if (moves > 100)
                break;
        }
        return moves;
    }

    bool fits(uint32_t share) const
    {
        return pages(1) < 0.86 * pageBytes(share) && texels(1) < 0.86 * texelBytes(share);
    }

    /// True if a side is worse off that could be given memory without the other being worse off then.
    bool isUneven(float geometry_scale, float texture_scale) const
    {
        const float g = geometry_scale, t = texture_scale;
        return std::max(g, t) > 1.25f * std::min(g, t) || (std::min(g, t) == 1 && std::max(g, t) > 1);
    }
};

TEST(MemoryBalance, settlesForConstantDemands)
{
    std::mt19937 random(2);
    size_t moved = 0, fitting = 0;
    const size_t count = trials(3000);
    for (size_t trial = 0; trial < count; ++trial)
    {
        SCOPED_TRACE(trial);
        const bool is_lumpy = trial % 4 == 0;
        Sides sides;
        sides.texels = makeDemand(random, 64 << 20, is_lumpy);
        sides.range.start_granules = static_cast<uint32_t>(random() % 13);
        MemoryBalance balance(sides.range);
        // bounds that the search has found for one demand must not hold for the next
        for (int view = 0; view < 2; ++view)
        {
            sides.pages = makeDemand(random, 64 << 20, is_lumpy);
            const uint32_t moves = sides.settle(balance);
            ASSERT_LE(moves, 2 * sides.range.granules + 3);
            EXPECT_TRUE(balance.atRest());
            moved += moves > 0 ? 1u : 0u;
            bool fits = false;
            for (uint32_t share = 0; share <= sides.range.granules; ++share)
                fits = fits || sides.fits(share);
            if (!fits || is_lumpy) // lumps may leave both sides worse off, and equally so
                continue;
            ++fitting;
            EXPECT_EQ(sides.geometry.value(), 1);
            EXPECT_EQ(sides.textures.value(), 1);
        }
    }
    EXPECT_GT(moved, count / 2);
    EXPECT_GT(fitting, count / 8);
}

TEST(MemoryBalance, endsWithinItsToleranceForSmoothDemands)
{
    std::mt19937 random(3);
    for (size_t trial = 0; trial < trials(1000); ++trial)
    {
        SCOPED_TRACE(trial);
        Sides sides;
        // both want 1 to 8 times the budget, so that neither end of the range is best
        const auto demand = [&]() -> Demand
        {
            const double bytes = (64 << 20) * (1 + static_cast<double>(random() % 64) / 16);
            return [bytes](double scale) { return bytes / (scale * scale); };
        };
        sides.pages = demand();
        sides.texels = demand();
        sides.range.start_granules = static_cast<uint32_t>(random() % 13);
        MemoryBalance balance(sides.range);
        EXPECT_LE(sides.settle(balance), 6u);
        EXPECT_FALSE(sides.isUneven(sides.geometry.value(), sides.textures.value()))
            << sides.geometry.value() << " " << sides.textures.value() << " " << balance.share();
    }
}

TEST(MemoryBalance, waitsWhileScalesComeNearer)
{
    MemoryBalance balance(
        {.total_bytes = 1000, .fixed_bytes = 100, .granule_bytes = 100, .granules = 8, .start_granules = 4});
    float scale = 64;
    for (; scale > 2; scale *= 0.98f)
        EXPECT_EQ(balance.update({scale, 1000}, {1, 100}), 4u);
    EXPECT_FALSE(balance.atRest());
    for (int round = 0; round < 33; ++round, scale *= 1.02f)
        balance.update({scale, 1000}, {1, 100});
    EXPECT_GT(balance.share(), 4u) << "geometry fares worse and worse";
}

} // namespace

} // namespace hearth::test

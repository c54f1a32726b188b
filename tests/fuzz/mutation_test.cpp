// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/fuzz/exercise_pack.h"
#include "tests/support/small_pack.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>

namespace hearth::test
{

namespace
{

// Values that often break a record's field: ends of ranges, signs, NaN, infinity.
constexpr uint32_t kNastyWords[] = {0u,          1u,          2u,          0x7FFFFFFFu, 0x80000000u,
                                    0xFFFFFFFEu, 0xFFFFFFFFu, 0x7F800000u, 0xFF800000u, 0x7FC00000u,
                                    0x3F800000u, 0x00000001u, 0x0000FFFFu, 0x00010000u, 0x42000000u};

void mutateWord(std::span<std::byte> bytes, std::mt19937& random)
{
    const size_t at = std::uniform_int_distribution<size_t>(0, bytes.size() / 4 - 1)(random) * 4;
    uint32_t word;
    std::memcpy(&word, bytes.data() + at, 4);
    switch (random() % 4)
    {
    case 0:
        word = kNastyWords[random() % std::size(kNastyWords)];
        break;
    case 1:
        word ^= 1u << random() % 32;
        break;
    case 2:
        word += static_cast<uint32_t>(random() % 5) - 2;
        break;
    default:
        std::memcpy(&word, bytes.data() + random() % (bytes.size() / 4) * 4, 4);
        break;
    }
    std::memcpy(bytes.data() + at, &word, 4);
}

/// Copy a run of records over another.
void mutateBlock(std::span<std::byte> bytes, std::mt19937& random)
{
    const size_t size = std::min<size_t>(bytes.size(), 4 * (1 + random() % 32));
    std::uniform_int_distribution<size_t> place(0, bytes.size() - size);
    std::memmove(bytes.data() + place(random) / 4 * 4, bytes.data() + place(random) / 4 * 4, size);
}

/// Open `count` mutated packs; returns how often each class of issue occurred (issue number / 1000; 0:
/// accepted).
std::map<uint32_t, int> exerciseMutations(bool compressed, int count, uint32_t seed)
{
    const AlignedBytes original = smallPack().bytes(compressed);
    std::mt19937 random(seed);
    std::map<uint32_t, int> outcomes;
    for (int i = 0; i < count; ++i)
    {
        AlignedBytes bytes = original;
        // mutate behind the header: any change of the header is rejected at once
        const std::span<std::byte> body = bytes.span().subspan(sizeof(formats::FileHeader));
        for (auto changes = 1 + random() % 3; changes > 0; --changes)
            random() % 8 == 0 ? mutateBlock(body, random) : mutateWord(body, random);
        repairPageHashes(bytes.span());
        repairHashes(bytes.span());
        const Status status = exercisePack(bytes.span());
        ++outcomes[status.ok() ? 0 : static_cast<uint32_t>(status.error().issue) / 1000];
    }
    return outcomes;
}

} // namespace

TEST(MutatedPack, isRefusedOrSafeToUse)
{
    std::map<uint32_t, int> outcomes = exerciseMutations(false, 20000, 1);
    // Most mutations must get past the container; otherwise the checker was not exercised.
    EXPECT_GT(outcomes[3], 5000);
    EXPECT_GT(outcomes[0], 1000);
    EXPECT_GT(outcomes[2], 500);
}

TEST(MutatedPack, isRefusedOrSafeToUseWhenCompressed)
{
    std::map<uint32_t, int> outcomes = exerciseMutations(true, 10000, 2);
    EXPECT_GT(outcomes[2], 3000);
    EXPECT_GT(outcomes[3], 500) << "damaged frames that still decode";
}

TEST(MutatedPack, isTheSameForTheSameSeed)
{
    EXPECT_EQ(exerciseMutations(false, 200, 3), exerciseMutations(false, 200, 3));
}

} // namespace hearth::test

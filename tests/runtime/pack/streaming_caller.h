// Simulates a renderer that uses the streaming policy: frames, loads with durations, failures; and checks the
// guarantees.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/residency.h"
#include "tests/runtime/pack/residency_model.h"

#include <map>
#include <random>
#include <set>
#include <vector>

namespace hearth::test
{

/// Parameters of loads and frames. Random numbers are drawn up to these limits.
struct Machine
{
    uint32_t most_load_frames = 3; ///< duration of a load
    uint32_t most_frames_late = 2; ///< frames that run beside the one being recorded
    uint32_t failures_of_64 = 0;   ///< failing loads
    std::set<uint32_t> bad_pages;  ///< pages whose loads always fail
};

/// Drives a Residency and its model side by side. Expects each answer to equal the model's, and the
/// guarantees about resident sets, bytes and order to hold after every call.
class StreamingCaller
{
public:
    StreamingCaller(const std::vector<pack::PageNode>& nodes, const pack::ResidencyOptions& options,
                    const Machine& machine, uint32_t seed);

    using Requests = std::vector<std::pair<uint32_t, float>>;

    /// Run one frame. Returns true if anything changed or is still in flight.
    bool frame(const Requests& requests);

    /// Run frames with the same requests until nothing has changed for `quiet` frames; returns their number,
    /// or `most`.
    uint32_t settle(const Requests& requests, uint32_t most = 2000, uint32_t quiet = 20);

    void retryFailed();
    void setBudget(uint64_t bytes);

    /// Let no load fail from now on.
    void mend();

    const std::vector<uint8_t>& resident() const { return resident_; }
    std::vector<uint32_t> residentPages() const;
    const pack::Residency& residency() const { return residency_; }
    const std::map<uint32_t, uint32_t>& failureCounts() const { return failure_count_of_page_; }
    uint64_t startCount() const { return start_count_; }
    uint64_t evictionCount() const { return eviction_count_; }

private:
    void apply(const ChangeLists& changes);
    void evict(uint32_t page);
    void publish(uint32_t page);
    void startLoads(const std::vector<uint32_t>& pages);
    void endLoads();
    void expectBytesInBudget();
    uint32_t roll(uint32_t end) { return static_cast<uint32_t>(random_() % end); }

    std::vector<pack::PageNode> nodes_;
    pack::ResidencyOptions options_;
    Machine machine_;
    std::mt19937 random_;
    pack::Residency residency_;
    ResidencyModel model_;
    std::vector<uint8_t> resident_;
    std::map<uint32_t, uint32_t> loads_; ///< page -> frames until it ends
    std::set<uint32_t> loaded_;          ///< completed, not published
    std::map<uint32_t, uint64_t> held_;  ///< evicted page -> last frame that reads it
    std::map<uint32_t, uint32_t> failure_count_of_page_, ended_badly_;
    uint64_t serial_ = 0, completed_serial_ = 0;
    uint64_t max_bytes_; ///< the budget, or after it has shrunk what is still in use
    uint64_t start_count_ = 0, eviction_count_ = 0;
};

/// Up to `most_pages` pages of 1 to 64 bytes in a random graph with companions; page 0 is a root.
std::vector<pack::PageNode> randomPages(std::mt19937& random, uint32_t most_pages);

/// Bytes of the pinned pages, and of all.
uint64_t pinnedBytes(const std::vector<pack::PageNode>& nodes);
uint64_t allBytes(const std::vector<pack::PageNode>& nodes);

/// The pages together with all that they need, ascending.
std::set<uint32_t> computeClosure(const std::vector<pack::PageNode>& nodes, std::set<uint32_t> pages);

} // namespace hearth::test

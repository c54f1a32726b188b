// Model of the rules of runtime/pack/residency.h that visits every page at each call: the reference of the
// tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/residency.h"

#include <cstdint>
#include <map>
#include <vector>

namespace hearth::test
{

/// Copies of the lists of pack::FrameChanges, for comparison.
struct ChangeLists
{
    std::vector<uint32_t> evicted, published, released, discarded, failed;
    friend bool operator==(const ChangeLists&, const ChangeLists&) = default;
};

ChangeLists makeLists(const pack::FrameChanges& changes);

class ResidencyModel
{
public:
    ResidencyModel(const std::vector<pack::PageNode>& nodes, const pack::ResidencyOptions& options);

    ChangeLists beginFrame(uint64_t serial, uint64_t completed_serial);
    void request(uint32_t page, float priority);
    std::vector<uint32_t> schedule();
    void completed(uint32_t page, bool ok);
    void retryFailed();
    void setBudget(uint64_t bytes) { options_.budget_bytes = bytes; }

    uint64_t bytesInUse() const;

private:
    enum class State
    {
        absent,
        loading,
        loaded,
        resident,
        leaving,
        held,
        failed,
    };
    struct Page
    {
        State state = State::absent;
        bool pinned = false;
        double priority = 0;
        uint64_t round = 0;
        uint64_t last_serial = 0; ///< of a held page
    };
    using Pages = std::vector<Page>;

    std::map<uint32_t, double> wanted() const;
    uint64_t sumBytes(const Pages& pages, std::initializer_list<State> states) const;
    bool needsAre(const Pages& pages, uint32_t page, std::initializer_list<State> states) const;
    bool hasDependents(const Pages& pages, uint32_t page) const;
    void evictExcess();
    double worth(const Page& page) const;
    /// Page to evict next, or none.
    uint32_t leastWorth(const Pages& pages) const;

    std::vector<pack::PageNode> nodes_;
    pack::ResidencyOptions options_;
    Pages pages_;
    std::map<uint32_t, double> requests_;
    std::vector<uint32_t> leaving_, failures_;
    uint64_t serial_ = 0;
    uint64_t round_ = 1;
};

} // namespace hearth::test

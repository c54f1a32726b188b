// Prefix sum over a workgroup. W. Hillis, G. Steele, "Data parallel algorithms", 1986.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

const uint kScanThreads = 128u; // the largest workgroup that every device has

shared uint scan_sums[kScanThreads];

// Return the sum of `value` over the threads before this one; `total` is the sum over all threads. All
// threads must call it.
uint exclusiveScan(uint value, out uint total)
{
    uint lane = gl_LocalInvocationIndex;
    barrier(); // a previous call may still be reading
    scan_sums[lane] = value;
    barrier();
    for (uint step = 1u; step < kScanThreads; step <<= 1)
    {
        uint below = lane >= step ? scan_sums[lane - step] : 0u;
        barrier();
        scan_sums[lane] += below;
        barrier();
    }
    total = scan_sums[kScanThreads - 1u];
    return scan_sums[lane] - value;
}

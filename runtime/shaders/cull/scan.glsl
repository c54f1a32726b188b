// Prefix sum over a workgroup of 256 threads. W. Hillis, G. Steele, "Data parallel algorithms", 1986.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

shared uint scan_sums[256];

// Return the sum of `value` over the threads before this one; `total` is the sum over all threads. All
// threads must call it.
uint exclusiveScan256(uint value, out uint total)
{
    uint lane = gl_LocalInvocationIndex;
    barrier(); // a previous call may still be reading
    scan_sums[lane] = value;
    barrier();
    for (uint step = 1u; step < 256u; step <<= 1)
    {
        uint below = lane >= step ? scan_sums[lane - step] : 0u;
        barrier();
        scan_sums[lane] += below;
        barrier();
    }
    total = scan_sums[255];
    return scan_sums[lane] - value;
}

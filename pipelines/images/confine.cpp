// The filter is a program of classic BPF that lists the allowed system calls: seccomp(2),
// Documentation/userspace-api/seccomp_filter.rst of Linux.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/confine.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace hearth::images
{

namespace
{

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kReservesMemory = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kReservesMemory = true;
#else
constexpr bool kReservesMemory = false;
#endif
#else
constexpr bool kReservesMemory = false;
#endif

#if defined(__x86_64__)
constexpr uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr uint32_t kArchitecture = 0; // not known: no filter
#endif

// Calls that computing needs, the last two in threads that libraries have just made: glibc ends the process
// without them. None takes a path, and none reaches another process.
constexpr std::array kAllowedCalls = {
    __NR_read,          __NR_write,
    __NR_readv,         __NR_writev,
    __NR_recvfrom,      __NR_sendto,
    __NR_lseek,         __NR_fstat,
    __NR_close,         __NR_mmap,
    __NR_munmap,        __NR_mprotect,
    __NR_mremap,        __NR_madvise,
    __NR_brk,           __NR_futex,
    __NR_rt_sigaction,  __NR_rt_sigprocmask,
    __NR_rt_sigreturn,  __NR_sigaltstack,
    __NR_exit,          __NR_exit_group,
    __NR_clock_gettime, __NR_clock_nanosleep,
    __NR_nanosleep,     __NR_gettimeofday,
    __NR_getrandom,     __NR_sched_yield,
    __NR_getpid,        __NR_gettid,
    __NR_getrusage,     __NR_sched_getaffinity,
    __NR_rseq,          __NR_set_robust_list,
};

void setLimit(__rlimit_resource resource, rlim_t soft, rlim_t hard)
{
    const rlimit limit{soft, hard};
    ::setrlimit(resource, &limit);
}

sock_filter load(size_t offset)
{
    return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<uint32_t>(offset));
}

/// Skip the next instruction unless the loaded number is `number`.
sock_filter unlessEqual(uint32_t number)
{
    return BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1);
}

sock_filter answer(uint32_t action)
{
    return BPF_STMT(BPF_RET | BPF_K, action);
}

std::vector<sock_filter> makeFilter()
{
    // numbers of calls mean something else on another architecture, which a process can switch to
    std::vector<sock_filter> filter{
        load(offsetof(seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
        answer(SECCOMP_RET_KILL_PROCESS),
        load(offsetof(seccomp_data, nr)),
    };
    for (const long call : kAllowedCalls)
    {
        filter.push_back(unlessEqual(static_cast<uint32_t>(call)));
        filter.push_back(answer(SECCOMP_RET_ALLOW));
    }
    // limits of this process only: argument 0 is the process, and 0 this one
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<uint32_t>(__NR_prlimit64), 0, 3));
    filter.push_back(load(offsetof(seccomp_data, args)));
    filter.push_back(unlessEqual(0));
    filter.push_back(answer(SECCOMP_RET_ALLOW));
    filter.push_back(answer(SECCOMP_RET_ERRNO | EPERM));
    return filter;
}

} // namespace

void limitResources()
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::close_range(STDERR_FILENO + 1, ~0u, 0);
    if (!kReservesMemory)
        setLimit(RLIMIT_AS, kMaxMemory_bytes, kMaxMemory_bytes);
    setLimit(RLIMIT_CORE, 0, 0);
    setLimit(RLIMIT_FSIZE, 0, 0);
    renewCpuLimit();
}

void renewCpuLimit()
{
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto seconds = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
    rlimit limit{};
    ::getrlimit(RLIMIT_CPU, &limit);
    setLimit(RLIMIT_CPU, seconds + kMaxCpu_s, limit.rlim_max);
}

bool closeDoors()
{
    setLimit(RLIMIT_NOFILE, STDERR_FILENO + 1, STDERR_FILENO + 1);
    if (kArchitecture == 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return false;
    std::vector<sock_filter> filter = makeFilter();
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
}

} // namespace hearth::images

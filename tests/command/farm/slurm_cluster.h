// A Slurm cluster on this machine, in a folder: its own key, ports and daemons, all gone when it goes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <string>
#include <sys/types.h>
#include <vector>

namespace hearth::test
{

class SlurmCluster
{
public:
    /// Why there can be none on this machine; empty where there can.
    static std::string whyNot();

    /// One controller and nodes w1, w2, ... of one processor each, in partition "cook"; its files lie in `folder`/slurm.
    SlurmCluster(Sandbox& folder, int node_count);
    ~SlurmCluster();
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    /// Wait until so many nodes wait for work.
    bool waitForIdle(int count, int seconds);

    /// For programs that talk to it.
    std::vector<std::string> environment() const;
    ProgramEnd run(const std::vector<std::string>& command);

    /// "R w2": state of a job or array task and its node; empty where it is no longer in the queue.
    std::string stateOf(const std::string& job);

    /// What a power cut does to a node: its daemon and everything that it runs, by SIGKILL.
    /// returns  processes of jobs that were killed
    size_t killNode(const std::string& node);

    /// Last lines of the logs, for whoever wonders why a test fails.
    std::string logs() const;

private:
    struct Daemon
    {
        std::string name;
        pid_t process = 0;
    };
    void writeConfiguration(int node_count);
    void startDaemon(const std::string& name, std::vector<std::string> command);
    void end(Daemon& daemon, int signal);

    Sandbox& folder_;
    std::string path_;
    std::vector<Daemon> daemons_;
};

} // namespace hearth::test

// Slurm cluster on this machine, in a folder: its own key, ports and daemons, all removed by the destructor.
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
    /// Return the reason why this machine cannot run a cluster; empty if it can.
    static std::string whyNot();

    /// Start one controller and nodes w1, w2, ... of one processor each, in partition "cook". Their files lie
    /// in `folder`/slurm.
    SlurmCluster(Sandbox& folder, int node_count);
    ~SlurmCluster();
    SlurmCluster(const SlurmCluster&) = delete;
    SlurmCluster& operator=(const SlurmCluster&) = delete;

    /// Wait until this many nodes are idle.
    bool waitForIdle(int count, int seconds);

    /// Environment for programs that use the cluster.
    std::vector<std::string> environment() const;
    ProgramEnd run(const std::vector<std::string>& command);

    /// Return the state of a job or array task and its node, as "R w2"; empty if it is no longer in the
    /// queue.
    std::string getState(const std::string& job);

    /// Simulate a power cut of a node: kill its daemon and everything that it runs by SIGKILL.
    /// returns  number of killed processes of jobs
    size_t killNode(const std::string& node);

    /// Return the last lines of the logs, to find the reason of a failed test.
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

#pragma once

#include <string>
#include <vector>

namespace vibrosow {

/// Puts the job that this program runs in back into Slurm's queue, unless it was cancelled or is queued already: Slurm
/// itself does not requeue what has used up its time. Nothing outside of a Slurm job.
void requeue_in_slurm();

/// Hands a script over to Slurm with more options of sbatch; gives the number of the job. Throws InputError where there
/// is no Slurm or it refuses.
std::string submit_to_slurm(const std::string& script, const std::vector<std::string>& options);

}  // namespace vibrosow

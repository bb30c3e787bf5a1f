// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// From the first moment on SIGUSR1 does no harm, and SIGXFSZ (a limit on the size of files is reached) leaves it to
/// the write that fails to end the run.
void survive_signals();

/// From now on SIGINT, SIGTERM, SIGHUP (a terminal was closed; not under nohup) and SIGXCPU (a limit on CPU time is
/// reached) ask the run to stop after its step, and SIGUSR1 asks for a checkpoint. A second of the former ends the
/// program at once, with a sentence on how the run can go on.
void catch_signals();

/// The signal that asked the run to stop; 0: none.
int stop_signal();

/// Whether a checkpoint was asked for since the last call.
bool checkpoint_requested();

} // namespace talus

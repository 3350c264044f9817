// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file OptionChecks.h
 * Finds options that make no sense together.
 */

#ifndef OptionChecks_h
#define OptionChecks_h

#include <set>
#include <string>

struct Options;

namespace OptionChecks
{
using Names = std::set<std::string>;

/// Throws Failure with ExitCode::Usage for the first contradiction; `given` are the options' names.
void Check(const Options& options, const Names& given);

///@{
/// Throw the same for a kernel or a connectivity that no step has come after.
void CheckKernelIsUsed(const Options& options);
void CheckConnectivityIsUsed(const Options& options);
///@}
}

#endif

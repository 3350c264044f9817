// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Messages.h
 * Keeps what VTK would print, so that the program can say it once and in one line.
 */

#ifndef Messages_h
#define Messages_h

#include "vtkSmartPointer.h"

#include <sstream>
#include <string>
#include <vector>

class vtkObject;
class vtkOutputWindow;

/**
 * While it lives, errors and warnings of all VTK objects come here, and with them what libraries
 * below VTK write to std::cerr. Each is shortened to its sentence, without file, line and class.
 */
class Messages
{
public:
  Messages();
  ~Messages();
  Messages(const Messages&) = delete;
  void operator=(const Messages&) = delete;

  /**
   * While it lives, errors and warnings are thrown as std::runtime_error, which ends what VTK does:
   * not all of its readers survive to go on.
   */
  class Strictness
  {
  public:
    explicit Strictness(Messages& messages);
    ~Strictness();
    Strictness(const Strictness&) = delete;
    void operator=(const Strictness&) = delete;

  private:
    Messages& Keeper;
  };

  /**
   * What came since the last call: errors, warnings, or the most telling one of all, which is the
   * first error, the first warning or else what was written to std::cerr; empty when nothing came.
   */
  std::vector<std::string> TakeErrors();
  std::vector<std::string> TakeWarnings();
  std::string TakeReason();

private:
  void KeepError(vtkObject*, unsigned long, void* text);
  void KeepWarning(vtkObject*, unsigned long, void* text);
  void Keep(std::vector<std::string>& messages, const void* text) const;

  vtkSmartPointer<vtkOutputWindow> Window;
  vtkSmartPointer<vtkOutputWindow> FormerWindow;
  std::ostringstream Written;
  std::streambuf* FormerBuffer;
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  bool IsStrict = false;
};

#endif

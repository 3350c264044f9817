/**
 * @file   VoxelTestObservers.h
 * @brief  Catches what a VTK object reports, so that tests can look at it.
 */
#ifndef VoxelTestObservers_h
#define VoxelTestObservers_h

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

#include <iostream>
#include <string>
#include <vector>

/// For tests made of many small checks: counts those that don't hold and names them.
class VoxelTestChecks
{
public:
  void Check(const std::string& name, bool holds)
  {
    if (!holds)
    {
      std::cerr << name << " does not hold\n";
      ++this->Failures;
    }
  }

  template <typename A, typename B>
  void Equal(const std::string& name, const A& found, const B& expected)
  {
    if (!(found == expected))
    {
      std::cerr << name << ": found " << found << ", expected " << expected << "\n";
      ++this->Failures;
    }
  }

  bool Passed() const { return this->Failures == 0; }

private:
  int Failures = 0;
};

/// Errors and warnings of an algorithm, none of which is printed while this lives. What its
/// executive adds to a failure of the algorithm is dropped.
class VoxelTestObserver
{
public:
  explicit VoxelTestObserver(vtkAlgorithm* algorithm)
  {
    this->Observe(algorithm, vtkCommand::ErrorEvent, this->Errors);
    this->Observe(algorithm, vtkCommand::WarningEvent, this->Warnings);
    this->Observe(algorithm->GetExecutive(), vtkCommand::ErrorEvent, this->Dropped);
  }
  ~VoxelTestObserver()
  {
    for (const auto& [object, tag] : this->Tags)
    {
      object->RemoveObserver(tag);
    }
  }
  VoxelTestObserver(const VoxelTestObserver&) = delete;
  VoxelTestObserver& operator=(const VoxelTestObserver&) = delete;

  /// That there was one error, and what it says.
  void ExpectOneError(
    VoxelTestChecks& checks, const std::string& name, const std::string& says) const
  {
    checks.Equal(name + ": number of errors", this->Errors.size(), std::size_t(1));
    if (!this->Errors.empty() && this->Errors[0].find(says) == std::string::npos)
    {
      checks.Equal(name + ": the error", this->Errors[0], says);
    }
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;

private:
  void Observe(vtkObject* object, unsigned long event, std::vector<std::string>& texts)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&texts);
    command->SetCallback(
      [](vtkObject*, unsigned long, void* data, void* text) {
        static_cast<std::vector<std::string>*>(data)->emplace_back(static_cast<const char*>(text));
      });
    this->Tags.emplace_back(object, object->AddObserver(event, command));
  }

  std::vector<std::string> Dropped;
  std::vector<std::pair<vtkObject*, unsigned long>> Tags;
};

/// Aborts an algorithm when it tells its progress, after so many times that it may; while this
/// lives.
class VoxelTestAbort
{
public:
  explicit VoxelTestAbort(vtkAlgorithm* algorithm, int spared = 0)
    : Algorithm(algorithm)
    , Left(spared)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(
      [](vtkObject*, unsigned long, void* data, void*)
      {
        auto* abort = static_cast<VoxelTestAbort*>(data);
        if (abort->Left-- == 0)
        {
          abort->Algorithm->SetAbortExecute(1);
        }
      });
    this->Tag = algorithm->AddObserver(vtkCommand::ProgressEvent, command);
  }
  ~VoxelTestAbort()
  {
    this->Algorithm->RemoveObserver(this->Tag);
    this->Algorithm->SetAbortExecute(0);
  }
  VoxelTestAbort(const VoxelTestAbort&) = delete;
  VoxelTestAbort& operator=(const VoxelTestAbort&) = delete;

  bool HasCome() const { return this->Left < 0; }

private:
  vtkAlgorithm* Algorithm;
  int Left;
  unsigned long Tag;
};

#endif

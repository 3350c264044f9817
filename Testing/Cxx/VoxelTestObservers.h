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

#endif

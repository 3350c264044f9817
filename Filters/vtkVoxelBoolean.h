// SPDX-FileCopyrightText: Copyright (c) The VTK Voxelization developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkVoxelBoolean
 * @brief unions, intersections, differences and any other Boolean expression of voxel grids
 *
 * The inputs, connected by SetInputConnection and AddInputConnection, are any number of images on
 * one grid; see vtkVoxelFilter for what they may be. All of them are joined by an Operation, or by
 * an Expression of their names.
 *
 * <b>Expressions.</b> The inputs are named A, B, C and so on in the order of their connections (AA
 * follows Z), unless SetInputName names them. The operators are those of Python's sets, here from
 * the tightest to the loosest; operators of one kind go from left to right, and parentheses group.
 * | operator | result: voxels that are set in |
 * | --- | --- |
 * | `~A` | not A (complement within the grid) |
 * | `A - B` | A, but not B (difference) |
 * | `A & B` | both (intersection) |
 * | `A ^ B` | one, but not both (symmetric difference) |
 * | `A \| B` | one at least (union) |
 *
 * So `A | B - C` is A united with what is left of B; to cut C from both, write `(A | B) - C`.
 *
 * An operation or expression runs as one pass over the words of the slicemaps, 128 voxels at a
 * time, which reads each input once and writes the result once. More than eight inputs take a pass
 * for every seven further ones.
 *
 * <b>Errors.</b> One error, and an empty output: those of vtkVoxelFilter, inputs on different
 * grids, Complement with several inputs, and an expression that is malformed or names an input
 * that there is not; the error points at the column.
 *
 * Boolean operations on slicemaps, and the volume of an intersection, are after
 *
 * Elmar Eisemann, Xavier Decoret: Single-Pass GPU Solid Voxelization for Real-Time Applications.
 * Graphics Interface 2008, pp. 73-80, section 7.
 *
 * @sa vtkVoxelFilter vtkSlicemap
 */

#ifndef vtkVoxelBoolean_h
#define vtkVoxelBoolean_h

#include "vtkVoxelFilter.h"
#include "vtkVoxelizationModule.h" // for export macro

#include <map>    // for names
#include <memory> // for the implementation
#include <string> // for names
#include <vector> // for several inputs

class VTKVOXELIZATION_EXPORT vtkVoxelBoolean : public vtkVoxelFilter
{
public:
  static vtkVoxelBoolean* New();
  vtkTypeMacro(vtkVoxelBoolean, vtkVoxelFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OperationType
  {
    OPERATION_UNION = 0,
    OPERATION_INTERSECTION = 1,
    OPERATION_DIFFERENCE = 2,
    OPERATION_XOR = 3,
    OPERATION_COMPLEMENT = 4
  };

  ///@{
  /**
   * What joins all inputs where there is no Expression. Union (default): voxels set in one input at
   * least; Intersection: in all; Difference: in the first, but in no other one; Xor: in an odd
   * number of them; Complement: not in the only one.
   */
  vtkSetClampMacro(Operation, int, OPERATION_UNION, OPERATION_COMPLEMENT);
  vtkGetMacro(Operation, int);
  void SetOperationToUnion() { this->SetOperation(OPERATION_UNION); }
  void SetOperationToIntersection() { this->SetOperation(OPERATION_INTERSECTION); }
  void SetOperationToDifference() { this->SetOperation(OPERATION_DIFFERENCE); }
  void SetOperationToXor() { this->SetOperation(OPERATION_XOR); }
  void SetOperationToComplement() { this->SetOperation(OPERATION_COMPLEMENT); }
  ///@}

  ///@{
  /**
   * An expression of the inputs, such as "(A | B) - C", instead of an Operation. Null or an empty
   * string (default) is off. It is checked when the filter runs.
   */
  vtkSetStringMacro(Expression);
  vtkGetStringMacro(Expression);
  ///@}

  ///@{
  /**
   * Name of input i (from 0) in expressions: letters, digits and underscores, no digit first. Null
   * or an empty string gives it back the name that it has by default: A, B, ... Z, AA, AB and so
   * on.
   */
  void SetInputName(int i, const char* name);
  const char* GetInputName(int i);
  ///@}

  /**
   * Volume of the result of the last run in world units: number of voxels, counted on the GPU,
   * times the volume of one. -1 before any run.
   */
  double GetVolume();

  /**
   * Volume of the intersection of all inputs, whatever the operation, as they are now; worked out
   * and counted on the GPU when asked for. -1 before any run, or after one error.
   */
  double GetIntersectionVolume();

  /**
   * Whether the last run has left no voxel; so after an Intersection whether the inputs are
   * disjoint. True before any run.
   */
  bool IsEmpty();

protected:
  vtkVoxelBoolean();
  ~vtkVoxelBoolean() override;

  void CheckInputs(const std::vector<vtkVoxelGrid>& inputs) override;
  bool Process(const std::vector<vtkSlicemap*>& inputs, vtkSlicemap* output) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkVoxelBoolean(const vtkVoxelBoolean&) = delete;
  void operator=(const vtkVoxelBoolean&) = delete;

  void CheckGrids(const std::vector<vtkVoxelGrid>& inputs);
  std::vector<std::string> GetInputNames(std::size_t count);

  int Operation = OPERATION_UNION;
  char* Expression = nullptr;
  std::map<int, std::string> InputNames;
  std::string DefaultName; // the one that GetInputName answered last

  struct Internals;
  std::unique_ptr<Internals> Compiled;
};

#endif

// Times vtkDepthBufferVoxelizer on the objects that Karabassi, Papaioannou and Theoharis timed it
// on, or rather on such as have as many triangles, on meshes of ever more triangles, and on ever
// more triangles over each other. Mesh in memory, upload included, to image in memory:
//
//   OBJECT/Solid/SIZE, OBJECT/Surface/SIZE, OBJECT/Density/SIZE   along three axes, from the input
//   OBJECT/Auto/SIZE    solid, along one axis where that does
//   OBJECT/Again/SIZE   solid, of buffers that are there already
//   OBJECT/Prop/SIZE    solid, of an actor
//   OBJECT/Parity/SIZE  vtkSlicemapSolidVoxelizer, for comparison
//   OBJECT/Bits/SIZE, OBJECT/SurfaceBits/SIZE, OBJECT/ParityBits/SIZE
//                       solid, surface and parity that stay on the GPU, one bit a voxel
//   Sphere_TRIANGLES/METHOD/256   one shape from few to many triangles, by Solid, Auto or Parity
//   Shells_COUNT/METHOD/256       so many spheres inside each other, with equally many triangles
//
// The counter "voxels" is the number of voxels that are set, "buffers" that of buffers drawn each
// time. With --table it prints tables in Markdown, of the least of the times; with --pixels and
// --many only the second of them, bits on the GPU against the number of pixels, and the third,
// triangles.

#include "VoxelBenchmarks.h"

#include <vtkActor.h>
#include <vtkDepthBufferVoxelizer.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkSlicemapSolidVoxelizer.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>

using namespace VoxelBenchmarks;

namespace
{
const std::vector<int> Sizes = { 64, 128, 256, 512 };
constexpr int SizeOfMany = 256;

using Voxelizer = vtkSmartPointer<vtkVoxelizer>;
using Maker = Voxelizer (*)(const Mesh&);

template <int OutputMode>
Voxelizer MakeDepth(const Mesh& mesh)
{
  auto voxelizer = vtkSmartPointer<vtkDepthBufferVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->SetOutputMode(OutputMode);
  return voxelizer;
}

Voxelizer MakeAuto(const Mesh& mesh)
{
  auto voxelizer = vtkSmartPointer<vtkDepthBufferVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  voxelizer->AutomaticAxesOn();
  return voxelizer;
}

Voxelizer MakeOfProp(const Mesh& mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  auto voxelizer = vtkSmartPointer<vtkDepthBufferVoxelizer>::New();
  voxelizer->AddProp(actor);
  return voxelizer;
}

Voxelizer MakeParity(const Mesh& mesh)
{
  auto voxelizer = vtkSmartPointer<vtkSlicemapSolidVoxelizer>::New();
  voxelizer->SetInputData(mesh);
  return voxelizer;
}

template <Maker Make>
Voxelizer MakeBits(const Mesh& mesh)
{
  auto voxelizer = Make(mesh);
  voxelizer->HostOutputOff();
  return voxelizer;
}

struct Method
{
  const char* Name;
  Maker Make;
  bool IsNewMesh;
};

const std::vector<Method> Methods = {
  { "Solid", MakeDepth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID>, true },
  { "Surface", MakeDepth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SURFACE>, true },
  { "Density", MakeDepth<vtkDepthBufferVoxelizer::OUTPUT_MODE_DENSITY>, true },
  { "Auto", MakeAuto, true },
  { "Again", MakeDepth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID>, false },
  { "Prop", MakeOfProp, true },
  { "Parity", MakeParity, true },
};

const std::vector<Method> MethodsOfBits = {
  { "Bits", MakeBits<MakeDepth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SOLID>>, true },
  { "SurfaceBits", MakeBits<MakeDepth<vtkDepthBufferVoxelizer::OUTPUT_MODE_SURFACE>>, true },
  { "ParityBits", MakeBits<MakeParity>, true },
};

bool IsOfMany(const Method& method)
{
  const std::string name = method.Name;
  return name == "Solid" || name == "Auto" || name == "Parity";
}

void RunOnce(const Method& method, vtkVoxelizer* voxelizer, const Mesh& mesh)
{
  if (method.IsNewMesh)
  {
    Touch(mesh);
  }
  voxelizer->Modified();
  voxelizer->Update();
  if (!voxelizer->GetHostOutput())
  {
    Finish();
  }
}

void Time(benchmark::State& state, const Method& method, const Mesh& mesh)
{
  const auto voxelizer = method.Make(mesh);
  voxelizer->SetReferenceImage(MakeGrid(mesh, static_cast<int>(state.range(0))));
  voxelizer->Update();
  auto* depth = vtkDepthBufferVoxelizer::SafeDownCast(voxelizer);
  const int buffers = depth ? depth->GetNumberOfBufferDraws() : 0;
  for (auto _ : state)
  {
    RunOnce(method, voxelizer, mesh);
  }
  state.counters["voxels"] = static_cast<double>(voxelizer->GetNumberOfFilledVoxels());
  state.counters["buffers"] =
    depth ? double(depth->GetNumberOfBufferDraws() - buffers) / double(state.iterations()) : 0.0;
}

std::string ToText(double milliseconds)
{
  char text[32];
  std::snprintf(text, sizeof(text), milliseconds < 10.0 ? "%.1f" : "%.0f", milliseconds);
  return text;
}

double Milliseconds(
  const Method& method, const Mesh& mesh, int size, vtkIdType* voxels, int times = 7)
{
  const auto voxelizer = method.Make(mesh);
  voxelizer->SetReferenceImage(MakeGrid(mesh, size));
  RunOnce(method, voxelizer, mesh);
  double least = 1e30;
  for (int i = 0; i < times; ++i)
  {
    const auto start = std::chrono::steady_clock::now();
    RunOnce(method, voxelizer, mesh);
    const std::chrono::duration<double, std::milli> passed =
      std::chrono::steady_clock::now() - start;
    least = std::min(least, passed.count());
  }
  if (voxels)
  {
    *voxels = voxelizer->GetNumberOfFilledVoxels();
  }
  return least;
}

std::map<std::string, Mesh> MeshesOfMany()
{
  std::map<std::string, Mesh> meshes;
  for (const int resolution : { 16, 64, 256, 1024 })
  {
    const Mesh sphere = VoxelTestMeshes::Sphere({ 0, 0, 0 }, 1.0, resolution);
    meshes["Sphere_" + std::to_string(sphere->GetNumberOfPolys())] = sphere;
  }
  for (const int shells : { 1, 4, 16 })
  {
    std::vector<Mesh> parts;
    for (int i = 0; i < shells; ++i)
    {
      // The more shells, the fewer triangles each has.
      parts.push_back(VoxelTestMeshes::Sphere({ 0, 0, 0 }, 1.0 - 0.5 * i / shells,
        shells == 1     ? 256
          : shells == 4 ? 128
                        : 64));
    }
    meshes["Shells_" + std::to_string(shells)] = VoxelTestMeshes::Appended(parts);
  }
  return meshes;
}

/// Voxels and times of the paper's objects.
void PrintObjects()
{
  std::cout
    << "| object | triangles | size | voxels, solid | surface | parity | ms, solid | surface "
       "| density | one axis where it does | drawn already | prop | parity |\n"
       "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const auto& [name, mesh] : VoxelTestMeshes::PaperObjects())
  {
    for (const int size : { 64, 128, 256 })
    {
      std::map<std::string, vtkIdType> voxels;
      std::string times;
      for (const Method& method : Methods)
      {
        times += " " + ToText(Milliseconds(method, mesh, size, &voxels[method.Name])) + " |";
      }
      std::cout << "| " << name << " | " << mesh->GetNumberOfPolys() << " | " << size << "^3 | "
                << voxels["Solid"] << " | " << voxels["Surface"] << " | " << voxels["Parity"]
                << " |" << times << std::endl;
    }
  }
}

/// Times against the number of pixels, and how they grow from size to size.
void PrintPixels()
{
  std::cout << "| bits on the GPU, ms |";
  for (const int size : Sizes)
  {
    std::cout << " " << size << "^3 |";
  }
  std::cout << " times, from size to size |\n| --- | --- | --- | --- | --- | --- |\n";
  const auto objects = VoxelTestMeshes::PaperObjects();
  for (const char* const object : { "Polyhedron", "Torus" })
  {
    for (const Method& method : MethodsOfBits)
    {
      std::cout << "| " << object << ", " << method.Name << " |";
      std::string growth;
      double last = 0.0;
      for (const int size : Sizes)
      {
        constexpr int times = 25;
        const double least = Milliseconds(method, objects.at(object), size, nullptr, times);
        std::cout << " " << ToText(least) << " |";
        growth += last > 0.0 ? " " + ToText(least / last) : "";
        last = least;
      }
      std::cout << growth << " |" << std::endl;
    }
  }
}

/// Times of ever more triangles.
void PrintMany()
{
  std::cout << "| mesh at 256^3 | triangles | ms, solid | one axis where it does | parity |\n"
               "| --- | --- | --- | --- | --- |\n";
  for (const auto& [name, mesh] : MeshesOfMany())
  {
    std::cout << "| " << name << " | " << mesh->GetNumberOfPolys() << " |";
    for (const Method& method : Methods)
    {
      if (IsOfMany(method))
      {
        std::cout << " " << ToText(Milliseconds(method, mesh, SizeOfMany, nullptr)) << " |";
      }
    }
    std::cout << std::endl;
  }
}
}

int main(int argc, char* argv[])
{
  const std::string option = argc == 2 ? argv[1] : "";
  if (option == "--table" || option == "--pixels" || option == "--many")
  {
    const bool all = option == "--table";
    if (all)
    {
      PrintObjects();
      std::cout << "\n";
    }
    if (all || option == "--pixels")
    {
      PrintPixels();
      std::cout << "\n";
    }
    if (all || option == "--many")
    {
      PrintMany();
    }
    return 0;
  }
  const auto add = [](const std::string& name, const Method& method, const Mesh& mesh,
                     const std::vector<int>& sizes)
  {
    AddRows(
      name + "/" + method.Name,
      [method, mesh](benchmark::State& state) { Time(state, method, mesh); }, sizes);
  };
  for (const auto& [name, mesh] : VoxelTestMeshes::PaperObjects())
  {
    for (const auto* methods : { &Methods, &MethodsOfBits })
    {
      for (const Method& method : *methods)
      {
        add(name, method, mesh, Sizes);
      }
    }
  }
  for (const auto& [name, mesh] : MeshesOfMany())
  {
    for (const Method& method : Methods)
    {
      if (IsOfMany(method))
      {
        add(name, method, mesh, { SizeOfMany });
      }
    }
  }
  return RunRows(argc, argv);
}

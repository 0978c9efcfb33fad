#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "motion/shapes.hpp"

namespace motion
{
namespace
{
void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, bool root, const Vector3& scale,
             std::vector<Vector3>& vertices, std::vector<Eigen::Vector3i>& triangles)
{
  const aiMatrix4x4 pose = root ? aiMatrix4x4() : parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
  {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const int first = static_cast<int>(vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    {
      const aiVector3D p = pose * mesh.mVertices[i];
      vertices.emplace_back(p.x * scale.x(), p.y * scale.y(), p.z * scale.z());
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
      if (mesh.mFaces[i].mNumIndices == 3)
      {
        const unsigned* index = mesh.mFaces[i].mIndices;
        triangles.emplace_back(first + index[0], first + index[1], first + index[2]);
      }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    collect(scene, *node.mChildren[i], pose, false, scale, vertices, triangles);
}
}  // namespace

std::shared_ptr<const Mesh> loadMesh(const std::string& path, const Vector3& scale)
{
  Assimp::Importer importer;
  // Only the surface counts: normals, colours ... would keep equal vertices apart.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                                          aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                                          aiComponent_CAMERAS | aiComponent_MATERIALS);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType | aiProcess_RemoveComponent);
  if (!scene || !scene->mRootNode)
    throw InvalidInput("mesh file '" + path + "' cannot be read: " + std::string(importer.GetErrorString()).substr(0, 120));
  std::vector<Vector3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), true, scale, vertices, triangles);
  try
  {
    return std::make_shared<Mesh>(std::move(vertices), std::move(triangles));
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput("mesh file '" + path + "': " + error.what());
  }
}
}  // namespace motion

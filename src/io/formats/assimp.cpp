// Triangle meshes through Assimp, which holds coordinates in single precision: OBJ and STL.

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "io/formats/meshes.h"

namespace medial::io {

namespace {

/// Adds the triangles of a node and of all nodes below it.
void add_node(const aiScene& scene, const aiNode& root, TriangleMesh& mesh) {
  struct Item {
    const aiNode* node;
    aiMatrix4x4 transform;
  };
  std::vector<Item> stack = {{&root, root.mTransformation}};
  while (!stack.empty()) {
    const Item item = stack.back();
    stack.pop_back();
    for (unsigned i = 0; i < item.node->mNumMeshes; ++i) {
      const aiMesh& part = *scene.mMeshes[item.node->mMeshes[i]];
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (unsigned v = 0; v < part.mNumVertices; ++v) {
        const aiVector3D p = item.transform * part.mVertices[v];
        mesh.vertices.push_back({p.x, p.y, p.z});
      }
      for (unsigned f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        if (face.mNumIndices != 3) continue;  // points and lines
        mesh.faces.push_back(
            {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
      }
    }
    for (unsigned i = item.node->mNumChildren; i-- > 0;) {
      const aiNode* child = item.node->mChildren[i];
      stack.push_back({child, item.transform * child->mTransformation});
    }
  }
}

}  // namespace

Result<TriangleMesh> read_by_assimp(const Input& input) {
  Assimp::Importer importer;
  // Only positions and faces are of use; without the rest there is nothing that parts vertices.
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
          aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
  const aiScene* scene =
      importer.ReadFile(input.path, aiProcess_RemoveComponent | aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string text = importer.GetErrorString();
    if (text.empty()) text = "cannot be read as a mesh";
    return Error{ErrorCode::malformed, text, {}};
  }
  TriangleMesh mesh;
  add_node(*scene, *scene->mRootNode, mesh);
  if (mesh.faces.empty()) return Error{ErrorCode::empty, "holds no face", {}};
  return mesh;
}

Format with_meshes(Format format) {
  format.read_mesh = read_by_assimp;
  return format;
}

}  // namespace medial::io

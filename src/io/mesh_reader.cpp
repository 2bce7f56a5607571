// Triangle meshes: OBJ and STL through Assimp, PLY and OFF by readers of their own.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/format_name.h"
#include "io/guarded.h"
#include "io/mesh_tables.h"
#include "io/place.h"
#include "medial/io/mesh.h"

#ifdef MEDIAL_MESH
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

namespace medial::io {

namespace {

constexpr std::array<std::string_view, 4> mesh_formats{"obj", "stl", "ply", "off"};

#ifdef MEDIAL_MESH

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

Result<TriangleMesh> read_by_assimp(const std::string& path) {
  Assimp::Importer importer;
  // Only positions and faces are of use; without the rest there is nothing that parts vertices.
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
          aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string text = importer.GetErrorString();
    if (text.empty()) text = "cannot be read as a mesh";
    return Error{ErrorCode::malformed, text, in_file(path)};
  }
  TriangleMesh mesh;
  add_node(*scene, *scene->mRootNode, mesh);
  if (mesh.faces.empty()) return Error{ErrorCode::empty, "holds no face", in_file(path)};
  return mesh;
}

#else

Result<TriangleMesh> read_by_assimp(const std::string& path) {
  return Error{ErrorCode::unsupported,
               "this program was built without Assimp (MEDIAL_MESH), which reads .obj and .stl",
               in_file(path)};
}

#endif

}  // namespace

std::string known_mesh_formats() { return fmt::format(".{}", fmt::join(mesh_formats, " .")); }

Result<TriangleMesh> read_mesh(const std::string& path) {
  const std::string extension = format_name(path);
  if (std::ranges::find(mesh_formats, extension) == mesh_formats.end()) {
    return Error{
        ErrorCode::unsupported,
        fmt::format("'{}' is no mesh format; known are {}", extension, known_mesh_formats()),
        in_file(path)};
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored) || !std::ifstream(path).good()) {
    return Error{ErrorCode::unreadable, "cannot be opened", in_file(path)};
  }
  return guarded(path, [&]() -> Result<TriangleMesh> {
    if (extension != "ply" && extension != "off") return read_by_assimp(path);
    auto source = TextSource::open(path);
    if (!source) return std::move(source).error();
    return extension == "ply" ? read_ply(**source) : read_off(**source);
  });
}

}  // namespace medial::io

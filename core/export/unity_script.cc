#include "core/export/unity_script.h"

namespace capfit::exports {

std::string_view UnityScript() {
  return R"csharp(//
// Put this file and unity_colliders.json below Assets/. Add the component CapfitColliders to the
// root of the character while it stands as in its file, give it the JSON as `file`, and choose
// "Make colliders" in the component's menu. Doing it again replaces what was made.

using System;
using System.Collections.Generic;
using UnityEngine;
#if MAGICACLOTH2
using MagicaCloth2;
#endif

namespace Capfit
{
    [Serializable]
    public class ColliderFile
    {
        public string format = "";
        public int format_version;
        public string capfit = "";
        public string source = "";
        public string frame = "";
        public string profile = "";
        public BoneData[] bones = new BoneData[0];
        public SphereData[] spheres = new SphereData[0];
        public PairData[] pairs = new PairData[0];
        public int[] loneSpheres = new int[0];
        public CapsuleData[] capsules = new CapsuleData[0];
        public SphereData[] magicaSpheres = new SphereData[0];
    }

    [Serializable]
    public class BoneData
    {
        public string name = "";
        public int parent;
        public Vector3 position;
    }

    [Serializable]
    public class SphereData
    {
        public string name = "";
        public int bone;
        public Vector3 position;
        public Vector3 bonePosition;
        public float radius;
    }

    [Serializable]
    public class PairData
    {
        public string name = "";
        public int first;
        public int second;
    }

    [Serializable]
    public class CapsuleData
    {
        public string name = "";
        public int bone;
        public Vector3 position;
        public Vector3 bonePosition;
        public Vector3 up;
        public Vector3 boneUp;
        public float startRadius;
        public float endRadius;
        public float length;
        public int direction;
        public bool reverseDirection;
        public bool alignedOnCenter;
        public bool radiusSeparation;
    }

    public class CapfitColliders : MonoBehaviour
    {
        public enum Placement
        {
            // By positions in the character's frame: it must stand as when it was fitted.
            ModelSpace,
            // By offsets in the bones' own axes: in any pose, where the importer kept the axes.
            BoneLocal,
        }

        const string Prefix = "capfit_";
        const int ClothLimit = 32;

        public TextAsset file;
        public Placement placement = Placement.ModelSpace;
        // Gets the sphere pairs; all cloths below this object where it is empty.
        public Cloth[] cloths = new Cloth[0];
        public bool forUnityCloth = true;
        public bool forMagicaCloth = true;

        ColliderFile data;
        Transform[] boneTransforms = new Transform[0];

        [ContextMenu("Make colliders")]
        public void MakeColliders()
        {
            if (file == null)
            {
                Debug.LogError("capfit: no file is set");
                return;
            }
            data = JsonUtility.FromJson<ColliderFile>(file.text);
            if (data == null || data.format != "capfit-unity" || data.format_version != 1)
            {
                Debug.LogError("capfit: '" + file.name + "' is no collider file of this version");
                return;
            }
            RemoveColliders();
            FindBones();
            if (forUnityCloth) MakeClothSpheres();
#if MAGICACLOTH2
            if (forMagicaCloth) MakeMagicaColliders();
#endif
        }

        [ContextMenu("Remove colliders")]
        public void RemoveColliders()
        {
            foreach (Transform child in GetComponentsInChildren<Transform>(true))
            {
                if (child == null || !child.name.StartsWith(Prefix, StringComparison.Ordinal)) continue;
                if (Application.isPlaying) Destroy(child.gameObject);
                else DestroyImmediate(child.gameObject);
            }
        }

        void FindBones()
        {
            Transform[] all = GetComponentsInChildren<Transform>(true);
            boneTransforms = new Transform[data.bones.Length];
            for (int i = 0; i < data.bones.Length; ++i) boneTransforms[i] = FindBone(all, data.bones[i]);
        }

        // By name; of several the one nearest to where the bone stood.
        Transform FindBone(Transform[] all, BoneData bone)
        {
            Vector3 place = transform.TransformPoint(bone.position);
            Transform nearest = null;
            foreach (Transform candidate in all)
            {
                if (candidate.name != bone.name) continue;
                if (nearest != null &&
                    (nearest.position - place).sqrMagnitude <= (candidate.position - place).sqrMagnitude) continue;
                nearest = candidate;
            }
            if (nearest != null) return nearest;
            Debug.LogWarning("capfit: no bone '" + bone.name + "'; its colliders hang on the character itself");
            return transform;
        }

        Transform MakeChild(string childName, int bone, Vector3 position, Vector3 bonePosition)
        {
            Transform parent = bone < 0 ? transform : boneTransforms[bone];
            GameObject child = new GameObject(Prefix + childName);
            child.transform.SetParent(parent, false);
            Vector3 modelPlace = transform.TransformPoint(position);
            if (placement == Placement.ModelSpace || parent == transform) child.transform.position = modelPlace;
            else child.transform.localPosition = bonePosition;
            return child.transform;
        }

        static float LargestScale(Transform place)
        {
            Vector3 scale = place.lossyScale;
            return Mathf.Max(Mathf.Abs(scale.x), Mathf.Max(Mathf.Abs(scale.y), Mathf.Abs(scale.z)));
        }

        // A length of the file in units of `child`, which its bones may scale.
        float LengthIn(Transform child, float length)
        {
            return length * LargestScale(transform) / LargestScale(child);
        }

        void MakeClothSpheres()
        {
            SphereCollider[] colliders = new SphereCollider[data.spheres.Length];
            for (int i = 0; i < colliders.Length; ++i)
            {
                SphereData sphere = data.spheres[i];
                Transform child = MakeChild(sphere.name, sphere.bone, sphere.position, sphere.bonePosition);
                colliders[i] = child.gameObject.AddComponent<SphereCollider>();
                colliders[i].radius = LengthIn(child, sphere.radius);
            }
            List<ClothSphereColliderPair> pairs = new List<ClothSphereColliderPair>();
            foreach (PairData pair in data.pairs)
                pairs.Add(new ClothSphereColliderPair(colliders[pair.first], colliders[pair.second]));
            foreach (int lone in data.loneSpheres) pairs.Add(new ClothSphereColliderPair(colliders[lone]));
            if (colliders.Length > ClothLimit || data.pairs.Length > ClothLimit)
                Debug.LogWarning("capfit: Unity Cloth takes " + ClothLimit + " spheres and " + ClothLimit +
                                 " pairs; fit again with engine unity_cloth");
            Cloth[] targets = cloths.Length > 0 ? cloths : GetComponentsInChildren<Cloth>(true);
            foreach (Cloth cloth in targets) cloth.sphereColliders = pairs.ToArray();
            Debug.Log("capfit: " + colliders.Length + " spheres, " + pairs.Count + " pairs, for " +
                      targets.Length + " cloths");
        }

#if MAGICACLOTH2
        void MakeMagicaColliders()
        {
            foreach (CapsuleData capsule in data.capsules)
            {
                Transform child =
                    MakeChild("magica_" + capsule.name, capsule.bone, capsule.position, capsule.bonePosition);
                bool isModel = placement == Placement.ModelSpace || child.parent == transform;
                child.rotation = Quaternion.FromToRotation(
                    Vector3.up, isModel ? transform.TransformDirection(capsule.up)
                                        : child.parent.TransformDirection(capsule.boneUp));
                MagicaCapsuleCollider collider = child.gameObject.AddComponent<MagicaCapsuleCollider>();
                collider.direction = (MagicaCapsuleCollider.Direction)capsule.direction;
                collider.reverseDirection = capsule.reverseDirection;
                collider.alignedOnCenter = capsule.alignedOnCenter;
                collider.SetSize(LengthIn(child, capsule.startRadius), LengthIn(child, capsule.endRadius),
                                 LengthIn(child, capsule.length));
                collider.radiusSeparation = capsule.radiusSeparation;
            }
            foreach (SphereData sphere in data.magicaSpheres)
            {
                Transform child =
                    MakeChild("magica_" + sphere.name, sphere.bone, sphere.position, sphere.bonePosition);
                MagicaSphereCollider collider = child.gameObject.AddComponent<MagicaSphereCollider>();
                collider.SetSize(LengthIn(child, sphere.radius));
            }
            Debug.Log("capfit: " + (data.capsules.Length + data.magicaSpheres.Length) +
                      " Magica colliders; add them to the collider list of the MagicaCloth");
        }
#endif

#if UNITY_EDITOR
        [UnityEditor.MenuItem("Tools/Capfit/Add colliders to the selection")]
        static void AddToSelection()
        {
            if (UnityEditor.Selection.activeGameObject != null)
                UnityEditor.Undo.AddComponent<CapfitColliders>(UnityEditor.Selection.activeGameObject);
        }
#endif
    }
}
)csharp";
}

}  // namespace capfit::exports

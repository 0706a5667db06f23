// Builds the bones of a file below a character that is moved, turned and scaled, makes the colliders in
// both placements, and says where they are in the character's frame; those on the bones once more with
// the bones posed (PLACEMENT "Posed"):
//
//   sphere PLACEMENT name x y z radius        name in hexadecimal
//   pair PLACEMENT first second               names; second "-" for a lone sphere
//   capsule PLACEMENT name x y z radius x y z radius
//   ball PLACEMENT name x y z radius
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Text;
using Capfit;
using MagicaCloth2;
using UnityEngine;

[Serializable]
public class BoneFile { public BonePlace[] bones = new BonePlace[0], posed = new BonePlace[0]; }

[Serializable]
public class BonePlace
{
    public string name = "";
    public int parent;
    public Vector3 position;
    public Quaternion rotation;
    public float scale;
}

public static class Program
{
    static Transform root;

    static Transform[] made;

    static GameObject MakeCharacter(BonePlace[] bones)
    {
        GameObject character = new GameObject("character");
        root = character.transform;
        made = new Transform[bones.Length];
        for (int i = 0; i < bones.Length; ++i) made[i] = new GameObject(bones[i].name).transform;
        for (int i = 0; i < bones.Length; ++i)
            made[i].SetParent(bones[i].parent < 0 ? root : made[bones[i].parent], false);
        PlaceAll(bones);
        return character;
    }

    // Below a character at the origin, which then is moved, turned and scaled.
    static void PlaceAll(BonePlace[] bones)
    {
        root.localPosition = new Vector3();
        root.localRotation = Quaternion.identity;
        root.localScale = 1;
        HashSet<int> placed = new HashSet<int>();
        for (int i = 0; i < bones.Length; ++i) Place(bones, made, placed, i);
        root.localPosition = new Vector3(1, 2, 3);
        root.localRotation = new Quaternion(0.5f, -0.5f, 0.5f, 0.5f);
        root.localScale = 2;
    }

    // Parents first, since places are the whole character's.
    static void Place(BonePlace[] bones, Transform[] made, HashSet<int> placed, int i)
    {
        if (!placed.Add(i)) return;
        if (bones[i].parent >= 0) Place(bones, made, placed, bones[i].parent);
        made[i].position = bones[i].position;
        made[i].rotation = bones[i].rotation;
        made[i].localScale = bones[i].scale / made[i].parent.lossyScale.x;
    }

    static string At(Transform child, Vector3 local, float radius)
    {
        Vector3 p = root.InverseTransformPoint(child.TransformPoint(local));
        float scale = child.lossyScale.x / root.lossyScale.x;
        return string.Format(CultureInfo.InvariantCulture, "{0:R} {1:R} {2:R} {3:R}", p.x, p.y, p.z, radius * scale);
    }

    static string Name(Component collider)
    {
        return BitConverter.ToString(Encoding.UTF8.GetBytes(collider.name)).Replace("-", "");
    }

    static void Say(string placement, CapfitColliders component, Cloth cloth)
    {
        foreach (SphereCollider sphere in component.GetComponentsInChildren<SphereCollider>(true))
            Console.WriteLine("sphere {0} {1} {2}", placement, Name(sphere), At(sphere.transform, sphere.center, sphere.radius));
        foreach (ClothSphereColliderPair pair in cloth.sphereColliders)
            Console.WriteLine("pair {0} {1} {2}", placement, Name(pair.first), pair.second == null ? "-" : Name(pair.second));
        foreach (MagicaCapsuleCollider capsule in component.GetComponentsInChildren<MagicaCapsuleCollider>(true))
        {
            // As Magica Cloth 2 has them: centred from tip to tip, the start at +direction.
            if (capsule.direction != MagicaCapsuleCollider.Direction.Y || capsule.reverseDirection ||
                !capsule.alignedOnCenter || !capsule.radiusSeparation) throw new Exception("another kind of capsule");
            Vector3 start = Vector3.up * (0.5f * capsule.length - capsule.startRadius);
            Vector3 end = Vector3.up * -(0.5f * capsule.length - capsule.endRadius);
            Console.WriteLine("capsule {0} {1} {2} {3}", placement, Name(capsule),
                At(capsule.transform, start, capsule.startRadius), At(capsule.transform, end, capsule.endRadius));
        }
        foreach (MagicaSphereCollider ball in component.GetComponentsInChildren<MagicaSphereCollider>(true))
            Console.WriteLine("ball {0} {1} {2}", placement, Name(ball), At(ball.transform, new Vector3(), ball.radius));
    }

    public static int Main(string[] arguments)
    {
        BoneFile file = JsonUtility.FromJson<BoneFile>(File.ReadAllText(arguments[1]));
        GameObject character = MakeCharacter(file.bones);
        Cloth cloth = character.AddComponent<Cloth>();
        CapfitColliders component = character.AddComponent<CapfitColliders>();
        component.file = new TextAsset { text = File.ReadAllText(arguments[0]), name = "colliders" };
        foreach (CapfitColliders.Placement placement in Enum.GetValues(typeof(CapfitColliders.Placement)))
        {
            component.placement = placement;
            component.MakeColliders();
            component.MakeColliders();  // replaces the first ones
            Say(placement.ToString(), component, cloth);
            if (placement != CapfitColliders.Placement.BoneLocal) continue;
            PlaceAll(file.posed);
            Say("Posed", component, cloth);
            PlaceAll(file.bones);
        }
        component.RemoveColliders();
        // A set may be too large for Unity Cloth; nothing else is to be said of it.
        Debug.Problems.RemoveAll(problem => problem.Contains("Unity Cloth takes 32 spheres"));
        foreach (string problem in Debug.Problems) Console.Error.WriteLine(problem);
        return Debug.Problems.Count + component.GetComponentsInChildren<SphereCollider>(true).Length;
    }
}

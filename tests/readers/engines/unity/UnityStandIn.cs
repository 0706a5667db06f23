// As much of Unity's classes as CapfitColliders.cs calls: transforms with uniform scales, colliders that
// keep what they are given, JSON into public fields.
using System;
using System.Collections;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using System.Text;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 up { get { return new Vector3(0, 1, 0); } }
        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }
        public static Vector3 operator *(Vector3 a, float s) { return new Vector3(a.x * s, a.y * s, a.z * s); }
        public float sqrMagnitude { get { return Dot(this, this); } }
        public static float Dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
        public static Vector3 Cross(Vector3 a, Vector3 b)
        {
            return new Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        }
    }

    public struct Quaternion
    {
        public float x, y, z, w;
        public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
        public static Quaternion identity { get { return new Quaternion(0, 0, 0, 1); } }
        public static Quaternion Inverse(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }
        public static Vector3 operator *(Quaternion q, Vector3 v)
        {
            Vector3 axis = new Vector3(q.x, q.y, q.z);
            Vector3 twice = Vector3.Cross(axis, v) * 2;
            return v + twice * q.w + Vector3.Cross(axis, twice);
        }
        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            Vector3 u = new Vector3(a.x, a.y, a.z), v = new Vector3(b.x, b.y, b.z);
            Vector3 axis = v * a.w + u * b.w + Vector3.Cross(u, v);
            return new Quaternion(axis.x, axis.y, axis.z, a.w * b.w - Vector3.Dot(u, v));
        }
        public static Quaternion FromToRotation(Vector3 from, Vector3 to)
        {
            Vector3 axis = Vector3.Cross(from, to);
            double w = Math.Sqrt((double)from.sqrMagnitude * to.sqrMagnitude) + Vector3.Dot(from, to);
            if (w < 1e-6) return new Quaternion(1, 0, 0, 0);  // for `from` up
            double norm = Math.Sqrt(axis.sqrMagnitude + w * w);
            return new Quaternion((float)(axis.x / norm), (float)(axis.y / norm), (float)(axis.z / norm), (float)(w / norm));
        }
    }

    public static class Mathf
    {
        public static float Max(float a, float b) { return Math.Max(a, b); }
        public static float Abs(float a) { return Math.Abs(a); }
    }

    public static class Debug
    {
        public static List<string> Problems = new List<string>();
        public static void Log(string message) { }
        public static void LogWarning(string message) { Problems.Add(message); }
        public static void LogError(string message) { Problems.Add(message); }
    }

    public static class Application { public static bool isPlaying; }

    [AttributeUsage(AttributeTargets.Method)]
    public class ContextMenu : Attribute { public ContextMenu(string name) { } }

    public class Object
    {
        public virtual string name { get; set; }
        public static void Destroy(Object o) { DestroyImmediate(o); }
        public static void DestroyImmediate(Object o) { ((GameObject)o).transform.SetParent(null, false); }
    }

    public class TextAsset : Object { public string text; }

    public class GameObject : Object
    {
        public Transform transform;
        public List<Component> components = new List<Component>();
        public GameObject(string name)
        {
            this.name = name;
            transform = new Transform();
            transform.gameObject = this;
        }
        public T AddComponent<T>() where T : Component, new()
        {
            T component = new T();
            component.gameObject = this;
            components.Add(component);
            return component;
        }
    }

    public class Component : Object
    {
        public GameObject gameObject;
        public override string name { get { return gameObject.name; } set { gameObject.name = value; } }
        public Transform transform { get { return gameObject.transform; } }
        public T[] GetComponentsInChildren<T>(bool includeInactive) where T : Component
        {
            List<T> found = new List<T>();
            Collect(transform, found);
            return found.ToArray();
        }
        static void Collect<T>(Transform place, List<T> found) where T : Component
        {
            if (place is T) found.Add((T)(Component)place);
            foreach (Component component in place.gameObject.components)
                if (component is T) found.Add((T)component);
            foreach (Transform child in place.children) Collect(child, found);
        }
    }

    public class MonoBehaviour : Component { }

    public class Transform : Component
    {
        public Transform parent;
        public List<Transform> children = new List<Transform>();
        public Vector3 localPosition;
        public Quaternion localRotation = Quaternion.identity;
        public float localScale = 1;
        public void SetParent(Transform to, bool worldPositionStays)
        {
            if (parent != null) parent.children.Remove(this);
            parent = to;
            if (to != null) to.children.Add(this);
        }
        float Scale { get { return parent == null ? localScale : parent.Scale * localScale; } }
        public Vector3 lossyScale { get { return new Vector3(Scale, Scale, Scale); } }
        public Quaternion rotation
        {
            get { return parent == null ? localRotation : parent.rotation * localRotation; }
            set { localRotation = parent == null ? value : Quaternion.Inverse(parent.rotation) * value; }
        }
        public Vector3 position
        {
            get { return parent == null ? localPosition : parent.TransformPoint(localPosition); }
            set { localPosition = parent == null ? value : parent.InverseTransformPoint(value); }
        }
        public Vector3 TransformPoint(Vector3 p) { return position + rotation * (p * Scale); }
        public Vector3 InverseTransformPoint(Vector3 p)
        {
            return Quaternion.Inverse(rotation) * (p - position) * (1 / Scale);
        }
        public Vector3 TransformDirection(Vector3 d) { return rotation * d; }
    }

    public class SphereCollider : Component { public Vector3 center; public float radius; }

    public struct ClothSphereColliderPair
    {
        public SphereCollider first, second;
        public ClothSphereColliderPair(SphereCollider a) { first = a; second = null; }
        public ClothSphereColliderPair(SphereCollider a, SphereCollider b) { first = a; second = b; }
    }

    public class Cloth : Component { public ClothSphereColliderPair[] sphereColliders; }

    // Numbers, strings and booleans of JSON into public fields of the same type, as Unity's: a member of
    // another type is left as it is.
    public static class JsonUtility
    {
        public static T FromJson<T>(string text) { return (T)Convert(new JsonReader(text).Value(), typeof(T)); }

        static object Convert(object json, Type type)
        {
            if (type == typeof(string)) return json as string;
            if (type == typeof(bool)) return json is bool && (bool)json;
            if (type == typeof(int)) return json is double ? (int)(double)json : 0;
            if (type == typeof(float)) return json is double ? (float)(double)json : 0;
            if (type.IsArray)
            {
                List<object> list = (List<object>)json;
                Array array = Array.CreateInstance(type.GetElementType(), list.Count);
                for (int i = 0; i < list.Count; ++i) array.SetValue(Convert(list[i], type.GetElementType()), i);
                return array;
            }
            object made = Activator.CreateInstance(type);
            foreach (FieldInfo field in type.GetFields(BindingFlags.Public | BindingFlags.Instance))
            {
                object member;
                if (((Dictionary<string, object>)json).TryGetValue(field.Name, out member))
                    field.SetValue(made, Convert(member, field.FieldType));
            }
            return made;
        }
    }

    class JsonReader
    {
        readonly string text;
        int at;
        public JsonReader(string text) { this.text = text; }
        char Next() { while (char.IsWhiteSpace(text[at])) ++at; return text[at]; }
        public object Value()
        {
            char c = Next();
            if (c == '{') return Members();
            if (c == '[') return Entries();
            if (c == '"') return Text();
            int start = at;
            while (at < text.Length && ",]}\n \r\t".IndexOf(text[at]) < 0) ++at;
            string word = text.Substring(start, at - start);
            if (word == "true" || word == "false") return word == "true";
            return double.Parse(word, CultureInfo.InvariantCulture);
        }
        Dictionary<string, object> Members()
        {
            Dictionary<string, object> members = new Dictionary<string, object>();
            for (++at; Next() != '}';)
            {
                string key = Text();
                Next();
                ++at;  // the colon
                members[key] = Value();
                if (Next() == ',') ++at;
                Next();
            }
            ++at;
            return members;
        }
        List<object> Entries()
        {
            List<object> entries = new List<object>();
            for (++at; Next() != ']';)
            {
                entries.Add(Value());
                if (Next() == ',') ++at;
            }
            ++at;
            return entries;
        }
        string Text()
        {
            StringBuilder builder = new StringBuilder();
            for (++at; text[at] != '"'; ++at)
            {
                if (text[at] != '\\') { builder.Append(text[at]); continue; }
                char escape = text[++at];
                if (escape == 'u') { builder.Append((char)System.Convert.ToInt32(text.Substring(at + 1, 4), 16)); at += 4; }
                else builder.Append(escape == 'n' ? '\n' : escape == 't' ? '\t' : escape == 'r' ? '\r' : escape == 'b' ? '\b' : escape == 'f' ? '\f' : escape);
            }
            ++at;
            return builder.ToString();
        }
    }
}

namespace MagicaCloth2
{
    using UnityEngine;

    public class MagicaSphereCollider : Component
    {
        public float radius;
        public void SetSize(float size) { radius = size; }
    }

    public class MagicaCapsuleCollider : Component
    {
        public enum Direction { X, Y, Z }
        public Direction direction;
        public bool reverseDirection, alignedOnCenter, radiusSeparation;
        public float startRadius, endRadius, length;
        public void SetSize(float start, float end, float size) { startRadius = start; endRadius = end; length = size; }
    }
}

namespace UnityEditor
{
    using UnityEngine;

    [AttributeUsage(AttributeTargets.Method)]
    public class MenuItem : Attribute { public MenuItem(string path) { } }
    public static class Selection { public static GameObject activeGameObject; }
    public static class Undo
    {
        public static T AddComponent<T>(GameObject to) where T : Component, new() { return to.AddComponent<T>(); }
    }
}

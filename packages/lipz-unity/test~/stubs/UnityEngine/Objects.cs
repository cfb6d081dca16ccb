// The part of UnityEngine that the package uses, with as much behaviour as its tests need.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public class Object
    {
        public string name { get; set; } = "";

        public static bool operator ==(Object one, Object other)
        {
            return ReferenceEquals(one, other);
        }

        public static bool operator !=(Object one, Object other)
        {
            return !ReferenceEquals(one, other);
        }

        public override bool Equals(object other)
        {
            return ReferenceEquals(this, other);
        }

        public override int GetHashCode()
        {
            return System.Runtime.CompilerServices.RuntimeHelpers.GetHashCode(this);
        }
    }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>()
            where T : ScriptableObject
        {
            return Activator.CreateInstance<T>();
        }
    }

    public class Component : Object
    {
        public GameObject gameObject { get; internal set; }

        public T[] GetComponentsInChildren<T>()
        {
            return gameObject.All<T>();
        }
    }

    public class Behaviour : Component
    {
    }

    public class MonoBehaviour : Behaviour
    {
    }

    public class Transform : Component
    {
        public Vector3 position { get; set; }
    }

    public sealed class GameObject : Object
    {
        /// <summary>All objects, for tests.</summary>
        public static readonly List<GameObject> Everything = new List<GameObject>();

        private readonly List<Component> components = new List<Component>();

        public GameObject(string name)
        {
            this.name = name;
            transform = AddComponent<Transform>();
            Everything.Add(this);
        }

        public Transform transform { get; private set; }

        public T AddComponent<T>()
            where T : Component
        {
            T component = Activator.CreateInstance<T>();
            component.gameObject = this;
            component.name = name;
            components.Add(component);
            return component;
        }

        internal T[] All<T>()
        {
            var found = new List<T>();
            foreach (Component component in components)
            {
                if (component is T) found.Add((T)(object)component);
            }
            return found.ToArray();
        }

        public T GetComponent<T>()
        {
            return All<T>()[0];
        }
    }

    public struct Vector3
    {
        public float x;
        public float y;
        public float z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }
    }

    public struct Rect
    {
        public Rect(float x, float y, float width, float height)
        {
        }
    }

    public static class Screen
    {
        public static int width
        {
            get { return 640; }
        }

        public static int height
        {
            get { return 480; }
        }
    }

    public static class GUI
    {
        public static void Label(Rect position, string text)
        {
        }
    }

    public sealed class Mesh : Object
    {
        private readonly List<string> shapes = new List<string>();

        public Vector3[] vertices { get; set; }

        public int[] triangles { get; set; }

        public int blendShapeCount
        {
            get { return shapes.Count; }
        }

        public string GetBlendShapeName(int index)
        {
            return shapes[index];
        }

        public void AddBlendShapeFrame(
            string name, float weight, Vector3[] moves, Vector3[] normals, Vector3[] tangents)
        {
            if (vertices != null && moves.Length != vertices.Length) throw new ArgumentException("moves");
            shapes.Add(name);
        }
    }

    public sealed class Shader : Object
    {
        public static Shader Find(string name)
        {
            return new Shader { name = name };
        }
    }

    public sealed class Material : Object
    {
        public Material(Shader shader)
        {
        }
    }

    public class Renderer : Component
    {
        public Material sharedMaterial { get; set; }
    }

    public sealed class SkinnedMeshRenderer : Renderer
    {
        private readonly float[] weights = new float[256];

        public Mesh sharedMesh { get; set; }

        public void SetBlendShapeWeight(int index, float weight)
        {
            if (index >= sharedMesh.blendShapeCount) throw new IndexOutOfRangeException();
            weights[index] = weight;
        }

        public float GetBlendShapeWeight(int index)
        {
            return weights[index];
        }
    }

    public sealed class Sprite : Object
    {
    }

    public sealed class SpriteRenderer : Renderer
    {
        public Sprite sprite { get; set; }
    }

    public static class Debug
    {
        public static readonly List<string> Messages = new List<string>();
        public static readonly List<string> Warnings = new List<string>();

        public static void Log(object message)
        {
            Messages.Add(message.ToString());
        }

        public static void LogWarning(object message, Object context)
        {
            Warnings.Add(message.ToString());
        }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class SerializeField : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class HideInInspector : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : Attribute
    {
        public TooltipAttribute(string tooltip)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class AddComponentMenu : Attribute
    {
        public AddComponentMenu(string menuName)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class DisallowMultipleComponent : Attribute
    {
    }
}

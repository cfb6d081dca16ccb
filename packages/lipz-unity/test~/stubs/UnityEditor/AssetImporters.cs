// The part of UnityEditor that the package uses.
using System;
using System.Collections.Generic;

namespace UnityEditor.AssetImporters
{
    public sealed class ScriptedImporterAttribute : Attribute
    {
        public ScriptedImporterAttribute(int version, string extension)
        {
        }
    }

    public sealed class AssetImportContext
    {
        /// <summary>The errors, for tests.</summary>
        public readonly List<string> Errors = new List<string>();

        public string assetPath { get; set; }

        public UnityEngine.Object mainObject { get; private set; }

        public void LogImportError(string message)
        {
            Errors.Add(message);
        }

        public void AddObjectToAsset(string identifier, UnityEngine.Object asset)
        {
        }

        public void SetMainObject(UnityEngine.Object asset)
        {
            mainObject = asset;
        }
    }

    public abstract class ScriptedImporter : UnityEngine.Object
    {
        public abstract void OnImportAsset(AssetImportContext context);
    }
}

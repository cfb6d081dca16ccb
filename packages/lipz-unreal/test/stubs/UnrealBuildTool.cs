// The parts of Unreal's build tool that the build rules use.

using System;
using System.Collections.Generic;

namespace UnrealBuildTool
{
	public sealed class UnrealTargetPlatform
	{
		public static readonly UnrealTargetPlatform Win64 = new UnrealTargetPlatform();
	}

	public sealed class ReadOnlyTargetRules
	{
		public UnrealTargetPlatform Platform = UnrealTargetPlatform.Win64;
	}

	public sealed class BuildException : Exception
	{
		public BuildException(string format, params object[] arguments) : base(string.Format(format, arguments)) { }
	}

	public abstract class ModuleRules
	{
		public enum PCHUsageMode { UseExplicitOrSharedPCHs }

		protected ModuleRules(ReadOnlyTargetRules target) { }

		public PCHUsageMode PCHUsage;
		public readonly List<string> PublicDependencyModuleNames = new List<string>();
		public readonly List<string> PrivateDependencyModuleNames = new List<string>();
		public readonly List<string> PublicSystemIncludePaths = new List<string>();
		public readonly List<string> PublicAdditionalLibraries = new List<string>();
		public readonly string ModuleDirectory = ".";
	}
}

"""The Cog Integration Utilities: installing cogs and registering them with an application."""
